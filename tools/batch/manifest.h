/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace tool {

/** \brief Two files that are to be registered, as a manifest has them. */
struct Pair {
  std::string source, target;
  /** \brief What the user calls it; may be empty. */
  std::string name;
  /** \brief The file of a transformation to begin with; empty: none. */
  std::string guess;
};

/** \brief A list of pairs: a CSV with a header, or JSON lines.
 *
 * Only where the pairs stand in the file is held in memory.
 */
class Manifest {
public:
  /** \brief Read a manifest once, to find all mistakes.
   * \throws std::runtime_error naming the lines that are wrong
   */
  explicit Manifest(const std::string& path);

  std::size_t
  size() const
  {
    return places_.size();
  }

  /** \brief How long the file is, and a checksum: they tell manifests apart. */
  std::uint64_t
  bytes() const
  {
    return bytes_;
  }

  std::uint32_t
  checksum() const
  {
    return checksum_;
  }

  /** \brief Check that the file is still as it was.
   * \throws std::runtime_error where it is not
   */
  void
  checkUnchanged() const;

  /** \brief Read a pair again. */
  Pair
  operator[](std::size_t number) const;

private:
  using Row = std::function<Pair(const std::string& record)>;

  /** \brief Find the pairs, and all mistakes. */
  void
  read();

  [[noreturn]] void
  fail(const std::string& problem) const;

  std::string path_;
  /** \brief Reads a record. */
  Row pairOf_;
  bool is_json_ = false;
  mutable std::ifstream file_;
  std::vector<std::uint64_t> places_;
  std::uint64_t bytes_ = 0;
  std::uint32_t checksum_ = 0;
};

} // namespace tool
