/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "picture_of_result.h"

#include <stdexcept>

namespace tool {

void
checkPictures()
{
  throw std::runtime_error("--picture: this pcl_kss_icp was built without cairo, which "
                           "draws pictures");
}

void
writePicture(
    const Result&, const Options&, const Geometry&, const Geometry&, std::ostream&)
{
}

} // namespace tool
