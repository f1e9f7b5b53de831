/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "candidates/centers.h"
#include "candidates/rotations.h"
#include "candidates/some_energies.h"
#include "geometry/similarity.h"

#include <memory>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Which cloud the candidate centres belong to. */
enum class Role { SOURCE, TARGET };

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
   * \param[in] centers {C}, in the frame of the cloud \a centered
   * \param[in] centered the cloud whose centre is replaced
   */
  Candidates(std::shared_ptr<const CandidateRotations> rotations,
             std::vector<double> scales,
             CandidateCenters centers,
             Role centered);

  /** \brief The number of candidates. */
  std::size_t
  size() const
  {
    return rotations_->rotations().size() * scales_.size() * centers_.centers.size();
  }

  /** \brief {O}. */
  const CandidateRotations&
  rotations() const
  {
    return *rotations_;
  }

  /** \brief {S}. */
  const std::vector<double>&
  scales() const
  {
    return scales_;
  }

  /** \brief {C}. */
  const CandidateCenters&
  centers() const
  {
    return centers_;
  }

  /** \brief The cloud whose centre is replaced. */
  Role
  centered() const
  {
    return centered_;
  }

  /** \brief The centres at and around one of them: 27, fewer at the rim. */
  const std::vector<std::size_t>&
  centersAround(std::size_t center) const
  {
    return around_[center];
  }

  /** \brief The pose of a candidate, T_target_source. */
  Similarity
  pose(std::size_t index) const;

  /** \brief The placements of the candidates from \a begin on, \a count of them. */
  std::vector<Placement>
  placements(std::size_t begin, std::size_t count) const;

  /** \brief The placements of some candidates. */
  std::vector<Placement>
  placements(const std::vector<std::size_t>& indices) const;

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

  /** \brief The same among those whose energies are known: others are no lower. */
  std::vector<std::size_t>
  localMinima(const SomeEnergies& energies,
              unsigned int kernel,
              double distinct_angle) const;

  /** \brief Of candidates with one centre and scale whose rotations differ by less than
   * an angle, the first ones.
   * \param[in] candidates indices, in their order of preference
   * \param[in] angle radians
   */
  std::vector<std::size_t>
  distinct(const std::vector<std::size_t>& candidates, double angle) const;

private:
  struct Parts {
    std::size_t rotation, scale, center;
  };

  Parts
  partsOf(std::size_t index) const;

  /** The same among some.
   * \param[in] energies what has energies[i]
   * \param[in] among indices of those that may be minima
   */
  template <typename Energies>
  std::vector<std::size_t>
  localMinima(const Energies& energies,
              const std::vector<std::size_t>& among,
              unsigned int kernel,
              double distinct_angle) const;

  std::shared_ptr<const CandidateRotations> rotations_;
  std::vector<double> scales_;
  CandidateCenters centers_;
  Role centered_;
  std::vector<std::vector<std::size_t>> around_;
};

} // namespace kss
} // namespace pcl
