/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "merged_cloud.h"

#include "io/fields.h"
#include "io/value_output.h"
#include "io/vector_field.h"

#include <boost/functional/hash.hpp>

#include <array>
#include <cmath>
#include <stdexcept>
#include <unordered_set>

namespace tool {
namespace {

/** Takes the first point in each cube of a grid. */
class Thinning {
public:
  /** \param[in] edge of the cubes; 0: all points are taken */
  explicit Thinning(double edge)
  : edge_(edge)
  {
  }

  bool
  takes(const Eigen::Vector3d& point)
  {
    if (edge_ <= 0.0)
      return true;
    Cube cube;
    for (int axis = 0; axis < 3; ++axis)
      cube[axis] = std::floor(point[axis] / edge_) + 0.0; // -0 is 0
    return taken_.insert(cube).second;
  }

private:
  /** Its number along each axis, however far out. */
  using Cube = std::array<double, 3>;

  double edge_;
  std::unordered_set<Cube, boost::hash<Cube>> taken_;
};

/** What the points of a file have. */
struct Layout {
  bool doubles;
  PointExtras extras;
};

/** The header, as long for any number of points: what comes after it is written first.
 */
std::string
headerOf(const Layout& layout, const Model& model, std::size_t points)
{
  constexpr std::size_t DIGITS = 20;
  const std::string number = std::to_string(points);
  const std::string type = layout.doubles ? "double" : "float";
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment made by " +
                       model.maker + std::string(DIGITS - number.size(), ' ') +
                       "\nelement vertex " + number + '\n';
  for (const char* name : {"x", "y", "z"})
    header += "property " + type + ' ' + name + '\n';
  if (layout.extras.normals)
    header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (layout.extras.colours)
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (layout.extras.intensity)
    header += "property float intensity\n";
  return header + "property int scan\nend_header\n";
}

/** The colour of the points of a cloud; null where they have none. */
const pcl::PCLPointField*
colourOf(const pcl::PCLPointCloud2& cloud)
{
  for (const auto& field : cloud.fields)
    if (isPackedColour(field))
      return &field;
  return nullptr;
}

void
write(ValueOutput& output, const Eigen::Vector3d& vector, bool doubles)
{
  for (const double number : vector)
    if (doubles)
      output.write(number);
    else
      output.write(static_cast<float>(number));
}

/** Write the points of a scan. \return how many */
std::size_t
writeScan(const pcl::PCLPointCloud2& cloud,
          const pcl::kss::StoredPose& pose,
          std::size_t scan,
          const Layout& layout,
          Thinning& thinning,
          ValueOutput& output)
{
  const Eigen::Affine3d placed{Eigen::Matrix4d(pose)};
  const Eigen::Matrix3d rotation = placed.rotation();
  const VectorField positions(cloud, VectorField::POSITION);
  const VectorField normals(cloud, VectorField::NORMAL);
  const auto* colour = layout.extras.colours ? colourOf(cloud) : nullptr;
  const auto* intensity =
      layout.extras.intensity ? findField(cloud, "intensity") : nullptr;
  std::size_t written = 0;
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i) {
    const std::uint8_t* point = &cloud.data[i * cloud.point_step];
    const Eigen::Vector3d place = placed * positions.get(point);
    if (!place.allFinite() || !thinning.takes(place))
      continue;
    write(output, place, layout.doubles);
    if (layout.extras.normals)
      write(output, rotation * normals.get(point), false);
    if (colour) {
      const auto parts = getColour(*colour, point);
      for (int part = 0; part < 3; ++part)
        output.write(parts[part]);
    }
    if (intensity)
      output.write(static_cast<float>(getNumber(*intensity, point)));
    output.write(static_cast<std::int32_t>(scan + 1));
    ++written;
  }
  return written;
}

} // namespace

std::size_t
writeMergedCloud(const Model& model,
                 const std::vector<std::size_t>& group,
                 const std::vector<ScanLook>& looks,
                 const std::function<void()>& done,
                 std::ostream& stream)
{
  Eigen::AlignedBox3d box;
  Layout layout{};
  layout.extras = looks[group.front()].extras;
  for (const std::size_t scan : group) {
    const ScanLook& look = looks[scan];
    box.extend(look.box);
    layout.extras.normals &= look.extras.normals;
    layout.extras.colours &= look.extras.colours;
    layout.extras.intensity &= look.extras.intensity;
  }
  layout.doubles = singlePrecisionIsCoarse(box);
  Thinning thinning(model.spacing);

  stream << headerOf(layout, model, 0);
  ValueOutput output(stream, Storage::BINARY);
  std::size_t points = 0;
  for (const std::size_t scan : group) {
    const auto cloud = pointsOf(model.read(scan), model.samples);
    const ScanLook now = lookAt(cloud, model.result.scans[scan].transformation, 0);
    const PointExtras& had = looks[scan].extras;
    if (now.points != looks[scan].points || now.extras.normals != had.normals ||
        now.extras.colours != had.colours || now.extras.intensity != had.intensity)
      throw std::runtime_error(model.files[scan] + ": has changed since it was read");
    points += writeScan(cloud, model.result.scans[scan].transformation, scan, layout,
                        thinning, output);
    if (done)
      done();
  }
  stream.seekp(0);
  stream << headerOf(layout, model, points);
  stream.seekp(0, std::ios::end);
  return points;
}

} // namespace tool
