/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "candidates/rotations.h"

#include "candidates/rotation_cells.h"
#include "geometry/turns.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** Indices of rotations and their neighbours that are kept: 8 MB, and some 100 bytes
 * for each rotation. */
constexpr std::size_t most_kept = 1 << 20;

/** The step of so many rotations on SO(3). It has the volume 8 pi^2 in radians cubed: a
 * step is the edge of a cube of it. */
double
stepOf(std::size_t rotations)
{
  return std::cbrt(8.0 * M_PI * M_PI / rotations);
}

/** The radius of the ball that a kernel is, on SO(3) of so many rotations. */
double
radiusOf(unsigned int kernel, std::size_t rotations)
{
  return std::min(M_PI, 0.5 * (kernel - 1.0) * stepOf(rotations));
}

/** Steps that fill the circle, of about an angle. */
int
stepsOfCircle(double angle)
{
  return std::max(1, static_cast<int>(std::lround(2.0 * M_PI / angle)));
}

} // namespace

std::vector<std::size_t>
CandidateRotations::neighbours(std::size_t index, unsigned int kernel) const
{
  Neighbours& kept = kept_[kernel];
  const auto known = kept.find(index);
  if (known != kept.end())
    return known->second;
  std::vector<std::size_t> found = findNeighbours(index, kernel);
  if (kept_indices_ + found.size() < most_kept) {
    kept_indices_ += found.size() + 1;
    kept.emplace(index, found);
  }
  return found;
}

EulerRotations::EulerRotations(double angle_step)
: steps_(stepsOfCircle(angle_step))
{
  const auto turn = [this](int step, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(2.0 * M_PI * step / steps_, axis);
  };
  rotations_.reserve(steps_ * steps_ * steps_);
  for (int x = 0; x < steps_; ++x)
    for (int y = 0; y < steps_; ++y)
      for (int z = 0; z < steps_; ++z)
        rotations_.emplace_back(turn(z, Eigen::Vector3d::UnitZ()) *
                                turn(y, Eigen::Vector3d::UnitY()) *
                                turn(x, Eigen::Vector3d::UnitX()));
}

std::vector<std::size_t>
EulerRotations::findNeighbours(std::size_t index, unsigned int kernel) const
{
  const int x = index / (steps_ * steps_);
  const int y = index / steps_ % steps_;
  const int z = index % steps_;
  // odd, so that it has a middle; wider than the circle it would meet itself
  const int width = std::min<int>(kernel | 1, steps_);
  const auto around = [this](int step) { return (step + steps_) % steps_; };
  std::vector<std::size_t> found;
  for (int dx = -(width / 2); dx < width - width / 2; ++dx)
    for (int dy = -(width / 2); dy < width - width / 2; ++dy)
      for (int dz = -(width / 2); dz < width - width / 2; ++dz)
        if (dx != 0 || dy != 0 || dz != 0)
          found.push_back((around(x + dx) * steps_ + around(y + dy)) * steps_ +
                          around(z + dz));
  return found;
}

EvenRotations::EvenRotations(unsigned int number)
{
  // Alexa (2022): phi is the root of 2, psi the positive root of psi^4 = psi + 4.
  const double phi = std::sqrt(2.0);
  const double psi = 1.533751168755204288118041413;
  rotations_.reserve(number);
  for (unsigned int i = 0; i < number; ++i) {
    const double s = i + 0.5;
    const double alpha = 2.0 * M_PI * s / phi;
    const double beta = 2.0 * M_PI * s / psi;
    const double inner = std::sqrt(s / number);
    const double outer = std::sqrt(1.0 - s / number);
    rotations_.emplace_back(outer * std::cos(beta), inner * std::sin(alpha),
                            inner * std::cos(alpha), outer * std::sin(beta));
  }
  constexpr unsigned int usual_kernel = 3;
  const auto cells = std::make_shared<RotationCells>(
      RotationCells::chord(radiusOf(usual_kernel, number)), number);
  for (const Eigen::Quaterniond& rotation : rotations_)
    cells->add(rotation);
  cells_ = cells;
}

std::vector<std::size_t>
EvenRotations::findNeighbours(std::size_t index, unsigned int kernel) const
{
  const Eigen::Quaterniond& rotation = rotations_[index];
  const double radius = radiusOf(kernel, rotations_.size());
  const double smallest_cosine = std::cos(0.5 * radius);
  std::vector<std::size_t> found;
  cells_->anyNear(rotation, RotationCells::chord(radius), 0, [&](std::size_t i) {
    if (i != index && std::abs(rotations_[i].dot(rotation)) >= smallest_cosine)
      found.push_back(i);
    return false;
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

UprightRotations::UprightRotations(const Eigen::Vector3d& axis,
                                   int steps,
                                   int steps_of_kernel)
: steps_(steps)
, steps_of_kernel_(steps_of_kernel)
{
  for (int i = 0; i < steps; ++i)
    rotations_.emplace_back(Eigen::AngleAxisd(2.0 * M_PI * i / steps, axis));
}

std::vector<std::size_t>
UprightRotations::findNeighbours(std::size_t index, unsigned int kernel) const
{
  const int i = static_cast<int>(index);
  // to either side; once round at most
  const int reach =
      static_cast<int>(std::min<double>(kernel / 2 * double(steps_of_kernel_), steps_));
  std::vector<std::size_t> found;
  for (int other = 0; other < steps_; ++other) {
    const int apart = std::abs(other - i);
    if (other != i && std::min(apart, steps_ - apart) <= reach)
      found.push_back(other);
  }
  return found;
}

std::size_t
numberOfRotations(const Settings& settings)
{
  switch (settings.rotation_set) {
  case RotationSet::EULER: {
    const auto steps = static_cast<std::size_t>(stepsOfCircle(settings.angle_step));
    return steps * steps * steps;
  }
  case RotationSet::EVEN:
    break;
  }
  return settings.even_rotations;
}

std::unique_ptr<CandidateRotations>
candidateRotations(const Settings& settings)
{
  if (settings.rotation_axis != RotationAxis::ANY) {
    const double step = settings.rotation_set == RotationSet::EULER
                            ? settings.angle_step
                            : stepOf(settings.even_rotations);
    // they cost little: twice as close
    return std::make_unique<UprightRotations>(turnsOf(settings.rotation_axis).col(0),
                                              2 * stepsOfCircle(step), 2);
  }
  switch (settings.rotation_set) {
  case RotationSet::EULER:
    return std::make_unique<EulerRotations>(settings.angle_step);
  case RotationSet::EVEN:
    break;
  }
  return std::make_unique<EvenRotations>(settings.even_rotations);
}

} // namespace kss
} // namespace pcl
