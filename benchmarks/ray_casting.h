/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <Eigen/Core>

#include <vector>

/** What a scanner would measure in a place that is made of simple bodies. */
namespace benchmarks {

/** \brief Where a scanner looks. */
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction; ///< of length 1
};

/** \brief Bodies, all of them opaque; z points up. */
class Place {
public:
  /** \brief The ground: a plane through the origin that rises by so much per metre. */
  void
  addGround(const Eigen::Vector2d& slope);

  /** \brief A box that may be turned about the vertical axis.
   * \param[in] size along its own axes
   */
  void
  addBox(const Eigen::Vector3d& middle, const Eigen::Vector3d& size, double yaw = 0.0);

  /** \brief An upright cylinder with a lid. */
  void
  addCylinder(const Eigen::Vector3d& foot, double radius, double height);

  void
  addBall(const Eigen::Vector3d& middle, double radius);

  /** \brief How far it is to the nearest body; infinite where there is none. */
  double
  distance(const Ray& ray) const;

  /** \brief The part of the place that rays within a half-plane can meet: what a
   * spinning scanner needs for a column.
   * \param[in] edge a point of it and the direction from there on, away from its edge
   * \param[in] normal of the plane
   */
  Place
  slice(const Ray& edge, const Eigen::Vector3d& normal) const;

private:
  enum class Form { BOX, CYLINDER, BALL };

  struct Body {
    Form form;
    Eigen::Vector3d middle;
    Eigen::Vector3d half; ///< half of the size along the body's axes
    double cosine, sine;  ///< of the yaw
    double reach;         ///< of the ball around the body
  };

  void
  add(Form form,
      const Eigen::Vector3d& middle,
      const Eigen::Vector3d& half,
      double yaw);

  /** \brief Along a ray in a body's own frame; infinite where it misses. */
  static double
  distance(const Body& body, const Ray& ray);

  std::vector<Body> bodies_;
  Eigen::Vector3d ground_ = Eigen::Vector3d::Zero(); ///< normal; 0: no ground
};

} // namespace benchmarks
