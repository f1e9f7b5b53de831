/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "subject.h"

#include <Eigen/Core>

#include <ostream>
#include <string>
#include <vector>

namespace tool {

/** \brief What a picture says of a registration. */
struct PictureText {
  enum class Verdict { REGISTERED, AMBIGUOUS, NOT_REGISTERED };

  Verdict verdict;
  /** \brief What it is called, in a few words, and what more there is to say. */
  std::string title, details;
  /** \brief The programme that has drawn it. */
  std::string maker;
};

/** \brief A pose that a picture shows. */
struct PicturePose {
  Eigen::Matrix4d transformation;
  /** \brief What is said beneath it. */
  std::string caption;
};

/** \brief Draw both files before and after, the distances after it, and beneath them
 * the other poses that may be right, as PNG.
 * \param[in] poses the result first; may be empty
 * \throws std::runtime_error where that cannot be; the stream tells whether it could be
 * written
 */
void
drawPicture(const Subject& source,
            const Subject& target,
            const std::vector<PicturePose>& poses,
            const PictureText& text,
            std::ostream& stream);

} // namespace tool
