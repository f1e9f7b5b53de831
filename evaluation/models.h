/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string>
#include <vector>

/** The models of a folder: which files can be evaluated, and which cannot, and why. */
namespace evaluation {

/** \brief A file that holds a mesh or points. */
struct Model {
  std::string name; ///< unique: the path in the folder, without its extension
  std::string path;
  bool is_mesh = false;
};

/** \brief A file that is passed over. */
struct SkippedFile {
  std::string path, reason;
};

struct ModelFolder {
  std::vector<Model> models; ///< sorted by name
  std::vector<SkippedFile> skipped;
};

/** \brief Read every file of a folder and of the folders in it: OFF, PLY, OBJ, STL,
 * PCD.
 * \throws std::runtime_error where the folder cannot be read
 */
ModelFolder
modelsOf(const std::string& folder);

/** \brief So many models, spread about evenly over the sorted names; all where there
 * are no more, or \a number is 0. A larger number keeps those of a smaller one.
 */
std::vector<Model>
evenlyChosen(const std::vector<Model>& models, std::size_t number);

} // namespace evaluation
