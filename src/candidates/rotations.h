/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include <Eigen/Geometry>

#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

namespace pcl {
namespace kss {

class RotationCells;

/** \brief The candidate rotations {O}, and which of them are neighbours. */
class CandidateRotations {
public:
  using Rotations = std::vector<Eigen::Quaterniond>;

  virtual ~CandidateRotations() = default;

  /** \brief All rotations of the set. */
  const Rotations&
  rotations() const
  {
    return rotations_;
  }

  /** \brief The other rotations within the kernel of (e12) around one of them.
   *
   * What has been found is kept for the next time, but no more than a million of them.
   * \param[in] index a rotation of the set
   * \param[in] kernel the edge of the kernel in steps
   */
  std::vector<std::size_t>
  neighbours(std::size_t index, unsigned int kernel) const;

protected:
  virtual std::vector<std::size_t>
  findNeighbours(std::size_t index, unsigned int kernel) const = 0;

  Rotations rotations_;

private:
  using Neighbours = std::unordered_map<std::size_t, std::vector<std::size_t>>;

  mutable std::map<unsigned int, Neighbours> kept_; ///< by kernel
  mutable std::size_t kept_indices_ = 0;
};

/** \brief All triples of multiples of an angle, about x, then y, then z: (e10).
 *
 * [0, 2 pi / theta] names one angle at both ends, so that there are 2 pi / theta values
 * (12 by default) for each axis, 1728 in all. Angles wrap round, and so does the
 * kernel.
 */
class EulerRotations : public CandidateRotations {
public:
  /** \param[in] angle_step theta, in radians; rounded so that steps fill the circle */
  explicit EulerRotations(double angle_step);

protected:
  std::vector<std::size_t>
  findNeighbours(std::size_t index, unsigned int kernel) const override;

private:
  int steps_;
};

/** \brief Any number of rotations, evenly spread over SO(3): a super-Fibonacci spiral
 * (M. Alexa, "Super-Fibonacci Spirals: Fast, Low-Discrepancy Sampling of SO(3)", CVPR
 * 2022). Neighbours lie within a ball as wide as the kernel.
 */
class EvenRotations : public CandidateRotations {
public:
  /** \param[in] number how many rotations; at least 1 */
  explicit EvenRotations(unsigned int number);

protected:
  std::vector<std::size_t>
  findNeighbours(std::size_t index, unsigned int kernel) const override;

private:
  std::shared_ptr<const RotationCells> cells_;
};

/** \brief Rotations about one axis, all round. */
class UprightRotations : public CandidateRotations {
public:
  /** \param[in] axis unit vector
   * \param[in] steps how many rotations; at least 1
   * \param[in] steps_of_kernel how many of them a step of the kernel is
   */
  UprightRotations(const Eigen::Vector3d& axis, int steps, int steps_of_kernel);

protected:
  std::vector<std::size_t>
  findNeighbours(std::size_t index, unsigned int kernel) const override;

private:
  int steps_, steps_of_kernel_;
};

/** \brief How many rotations the set that the settings ask for has where they may be
 * about any axis: as far as its rotations lie apart, rotations about one axis do at
 * most.
 */
std::size_t
numberOfRotations(const Settings& settings);

/** \brief The set that the settings ask for. */
std::unique_ptr<CandidateRotations>
candidateRotations(const Settings& settings);

} // namespace kss
} // namespace pcl
