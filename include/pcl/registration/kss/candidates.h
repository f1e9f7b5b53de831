/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/candidate_centers.h>
#include <pcl/registration/kss/candidate_rotations.h>
#include <pcl/registration/kss/distances.h>

#include <memory>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Which cloud the candidate centres belong to. */
enum class Side { SOURCE, TARGET };

/** \brief The candidates of a search: {O} x {S} x {C}, rotations, scales and centres.
 *
 * A candidate turns and scales the source about its centre, and places that upon the
 * target's centre; the centre of one of the two clouds is replaced by c_i of {C}, as in
 * (e122). Both clouds are pre-shapes, centred at the origin.
 */
class Candidates {
public:
  /** \param[in] rotations {O}
   * \param[in] scales geometrically spaced, rising
   * \param[in] centers {C}, in the frame of the cloud \a side
   * \param[in] side the cloud whose centre is replaced
   */
  Candidates(std::shared_ptr<const CandidateRotations> rotations,
             std::vector<double> scales,
             CandidateCenters centers,
             Side side);

  /** \brief The number of candidates. */
  std::size_t
  size() const
  {
    return rotations_->rotations().size() * scales_.size() * centers_.centers.size();
  }

  /** \brief The pose of a candidate: a similarity from source to target. */
  Eigen::Matrix4d
  pose(std::size_t index) const;

  /** \brief The placements of the candidates from \a begin on, \a count of them. */
  std::vector<Placement>
  placements(std::size_t begin, std::size_t count) const;

  /** \brief The distinct local minima {(c, O)_local} of the additional process (e12),
   * by rising energy: candidates none of whose neighbours has a lower energy.
   *
   * Neighbours are the rotations within the kernel, at the same and at the adjacent
   * centres and scales. Of candidates with one centre and scale whose rotations differ
   * by less than \a distinct_angle (the Euler grid holds most rotations twice) one is
   * kept.
   * \param[in] energies an energy per candidate
   * \param[in] kernel edge of the kernel of rotations, in steps
   * \param[in] distinct_angle radians
   * \return indices of candidates; never empty
   */
  std::vector<std::size_t>
  localMinima(const std::vector<float>& energies,
              unsigned int kernel,
              double distinct_angle) const;

private:
  struct Parts {
    std::size_t rotation, scale, center;
  };

  Parts
  partsOf(std::size_t index) const;

  std::shared_ptr<const CandidateRotations> rotations_;
  std::vector<double> scales_;
  CandidateCenters centers_;
  Side side_;
};

} // namespace kss
} // namespace pcl
