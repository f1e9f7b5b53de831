/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "transformation_file.h"

#include <pcl/registration/kss/detail/similarity.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace tool {

std::string
transformationText(const Eigen::Matrix4d& transformation)
{
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (int i = 0; i < 4; ++i)
    text << transformation(i, 0) << ' ' << transformation(i, 1) << ' '
         << transformation(i, 2) << ' ' << transformation(i, 3) << '\n';
  return text.str();
}

Eigen::Matrix4d
readTransformation(const std::string& path)
{
  std::ifstream file(path);
  if (!file)
    throw std::runtime_error(path + ": " + std::strerror(errno));
  Eigen::Matrix4d transformation;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      file >> transformation(row, column);
  std::string more;
  if (!file || file >> more)
    throw std::runtime_error(
        path + ": holds no transformation, which is 4x4 numbers, row by row");
  if (!pcl::kss::isSimilarity(transformation))
    throw std::runtime_error(path + ": its transformation is not made of a rotation, a "
                                    "scale and a translation alone");
  return transformation;
}

} // namespace tool
