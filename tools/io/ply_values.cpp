/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "ply_values.h"

#include "numbers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace tool {
namespace {

/** An element stands in a line of its own. */
class TextValues : public PLYValues {
public:
  explicit TextValues(TextLines& lines)
  : lines_(lines)
  {
  }

  void
  beginElement() override
  {
    if (!lines_.next())
      throw std::runtime_error("holds fewer lines than its header announces; the file "
                               "is damaged or incomplete");
    words_ = &lines_.words();
    next_ = 0;
  }

  void
  take(std::uint8_t datatype, std::uint8_t* bytes) override
  {
    if (next_ == words_->size())
      fail("ends too early; the file is damaged or incomplete");
    const std::string_view word = (*words_)[next_++];
    if (!parseNumber(word, datatype, bytes))
      lines_.failAt(word, "is not a number, or none of the type in the header");
  }

  void
  endElement() override
  {
    if (next_ != words_->size())
      lines_.failAt((*words_)[next_], "is more than the header announces");
  }

  void
  end() override
  {
    if (lines_.next())
      fail("is more than the header announces");
  }

  [[noreturn]] void
  fail(const std::string& problem) const override
  {
    lines_.fail(problem);
  }

private:
  TextLines& lines_;
  const std::vector<std::string_view>* words_ = nullptr;
  std::size_t next_ = 0;
};

class BinaryValues : public PLYValues {
public:
  BinaryValues(std::istream& stream, bool is_big_endian)
  : stream_(stream)
  , is_big_endian_(is_big_endian)
  {
  }

  void
  beginElement() override
  {
  }

  void
  take(std::uint8_t datatype, std::uint8_t* bytes) override
  {
    const std::size_t size =
        withType(datatype, [](auto number) { return sizeof number; });
    takeBytes(bytes, size);
    if (is_big_endian_)
      std::reverse(bytes, bytes + size);
  }

  bool
  takeElements(std::uint8_t* bytes, std::size_t size) override
  {
    if (!is_big_endian_)
      takeBytes(bytes, size);
    return !is_big_endian_;
  }

  void
  endElement() override
  {
  }

  void
  end() override
  {
    if (stream_.rdbuf()->sgetc() != std::istream::traits_type::eof())
      fail("holds more data than its header announces; does the header name the right "
           "types?");
  }

  [[noreturn]] void
  fail(const std::string& problem) const override
  {
    throw std::runtime_error(problem);
  }

private:
  void
  takeBytes(std::uint8_t* bytes, std::size_t size)
  {
    if (stream_.rdbuf()->sgetn(reinterpret_cast<char*>(bytes), size) !=
        static_cast<std::streamsize>(size))
      fail("holds less data than its header announces; the file is damaged or "
           "incomplete");
  }

  std::istream& stream_;
  bool is_big_endian_;
};

} // namespace

std::uint32_t
PLYValues::takeCount(std::uint8_t datatype)
{
  std::uint8_t bytes[8];
  take(datatype, bytes);
  return withType(datatype, [&](auto number) {
    std::memcpy(&number, bytes, sizeof number);
    const auto wide = static_cast<double>(number);
    if (!(wide >= 0.0 && wide <= std::numeric_limits<std::int32_t>::max()) ||
        wide != std::floor(wide))
      fail("a list has a length, or the number of a point, that cannot be one: " +
           std::to_string(number));
    return static_cast<std::uint32_t>(wide);
  });
}

std::unique_ptr<PLYValues>
plyValues(PLYHeader::Encoding encoding, TextLines& lines, std::istream& stream)
{
  if (encoding == PLYHeader::Encoding::ASCII)
    return std::make_unique<TextValues>(lines);
  return std::make_unique<BinaryValues>(stream, encoding == PLYHeader::Encoding::BIG);
}

} // namespace tool
