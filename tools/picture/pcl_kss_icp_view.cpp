/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "colour_scale.h"
#include "distances.h"
#include "io/read_geometry.h"
#include "short_text.h"
#include "subject.h"
#include "view.h"

#include <pcl/console/print.h>
#include <pcl/visualization/pcl_visualizer.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <iostream>

/** \file
 * Shows two files and a report of their registration in a window; pcl_kss_icp --view
 * starts it.
 */

namespace {

using namespace tool;

using Cloud = pcl::PointCloud<pcl::PointXYZRGB>;

constexpr const char* USAGE =
    "Usage: pcl_kss_icp_view SOURCE TARGET REPORT\n"
    "\n"
    "Shows two files and what pcl_kss_icp --report REPORT says of them; REPORT may be "
    "-\n"
    "for standard input. Keys: Right and Left go through the poses, Up shows SOURCE "
    "as\n"
    "it lies in its file, Space its distances from TARGET in colour, q ends.\n";

nlohmann::json
readReport(const std::string& path)
{
  if (path == "-")
    return nlohmann::json::parse(std::cin);
  std::ifstream stream(path);
  if (!stream)
    throw std::runtime_error(path + ": cannot be read");
  return nlohmann::json::parse(stream);
}

std::vector<Eigen::Matrix4d>
posesOf(const nlohmann::json& report)
{
  std::vector<Eigen::Matrix4d> poses;
  for (const auto& alternative : report.at("alternatives")) {
    poses.emplace_back();
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        poses.back()(i, j) = alternative.at("transformation").at(i).at(j).get<double>();
  }
  return poses;
}

/** Both clouds, of which the source goes from pose to pose. */
class Window {
public:
  Window(Subject source, Subject target, const nlohmann::json& report)
  : source_(drawnOf(source.points))
  , nearest_(target.points)
  , poses_(posesOf(report))
  , is_before_(poses_.empty())
  {
    const Points drawn = drawnOf(target.points);
    const Eigen::Matrix3d view = viewOf(drawn);
    middle_ = view.transpose() * inView(view, drawn);
    verdict_ = !report.at("converged").get<bool>()
                   ? "Not registered: " + report.at("reason").get<std::string>()
                   : std::string("Registered") +
                         (report.at("ambiguous").get<bool>() ? ", but ambiguous" : "");
    viewer_.setSize(1000, 750);
    viewer_.setBackgroundColor(1.0, 1.0, 1.0);
    show("target", drawn, [](std::size_t) { return TARGET_COLOUR; });
    const double size = frameOf(seenFrom(view, drawn)).size.norm();
    const Eigen::Vector3d eye = 1.6 * size * view.row(2).transpose();
    viewer_.setCameraPosition(eye.x(), eye.y(), eye.z(), 0, 0, 0, view(1, 0),
                              view(1, 1), view(1, 2));
    viewer_.registerKeyboardCallback(
        [this](const pcl::visualization::KeyboardEvent& event) { press(event); });
    update();
  }

  void
  run()
  {
    viewer_.resetCamera();
    viewer_.spin();
  }

private:
  /** The middle of points, in a view. */
  static Eigen::Vector3d
  inView(const Eigen::Matrix3d& view, const Points& points)
  {
    const Frame frame = frameOf(seenFrom(view, points));
    return {frame.middle.x(), frame.middle.y(), view.row(2).dot(points.front())};
  }

  void
  press(const pcl::visualization::KeyboardEvent& event)
  {
    if (!event.keyDown() || poses_.empty())
      return;
    const std::string key = event.getKeySym();
    if (key == "Right" || key == "Left") {
      const std::size_t step = key == "Right" ? 1 : poses_.size() - 1;
      pose_ = (pose_ + (is_before_ ? 0 : step)) % poses_.size();
      is_before_ = false;
    }
    else if (key == "Up")
      is_before_ = !is_before_;
    else if (key == "space")
      is_coloured_ = !is_coloured_;
    else
      return;
    update();
    if (key == "Up") // it may lie anywhere
      viewer_.resetCamera();
  }

  /** Show the source at its pose, and say which one it is. */
  void
  update()
  {
    const Points placed = is_before_ ? source_ : moved(source_, poses_[pose_]);
    const bool is_coloured = is_coloured_ && !is_before_;
    std::string legend;
    if (is_coloured) {
      const Distances distances = distancesOf(placed, nearest_);
      show("source", placed,
           [&](std::size_t i) { return colourOf(distances.all[i] / distances.top); });
      legend = ", distances from 0 (dark) to " + shortText(distances.top) +
               " (light) in the unit of TARGET";
    }
    else
      show("source", placed, [](std::size_t) { return SOURCE_COLOUR; });
    viewer_.setPointCloudRenderingProperties(pcl::visualization::PCL_VISUALIZER_OPACITY,
                                             is_coloured ? 0.1 : 1.0, "target");
    say("verdict", verdict_, 3);
    say("pose",
        is_before_ ? "SOURCE (orange) as it lies in its file, TARGET (blue)"
                   : "Pose " + std::to_string(pose_ + 1) + " of " +
                         std::to_string(poses_.size()) + legend,
        2);
    say("keys", "Right, Left: poses   Up: before   Space: distances   q: end", 0);
  }

  void
  say(const std::string& id, const std::string& words, int row)
  {
    constexpr int SIZE = 15, MARGIN = 10, LINE = 22;
    if (!viewer_.updateText(words, MARGIN, MARGIN + LINE * row, SIZE, 0.1, 0.1, 0.1,
                            id))
      viewer_.addText(words, MARGIN, MARGIN + LINE * row, SIZE, 0.1, 0.1, 0.1, id);
  }

  template <typename ColourAt>
  void
  show(const std::string& id, const Points& points, const ColourAt& colour_at)
  {
    const auto cloud = pcl::make_shared<Cloud>();
    cloud->reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      pcl::PointXYZRGB point;
      point.getVector3fMap() = (points[i] - middle_).cast<float>();
      point.rgba = packed(colour_at(i));
      cloud->push_back(point);
    }
    const Cloud::ConstPtr constant = cloud;
    if (!viewer_.updatePointCloud(constant, id)) // not the template: with colours
      viewer_.addPointCloud(constant, id);
    constexpr std::size_t FEW = 20000;
    viewer_.setPointCloudRenderingProperties(
        pcl::visualization::PCL_VISUALIZER_POINT_SIZE, points.size() > FEW ? 2.0 : 4.0,
        id);
  }

  Points source_;
  NearestPoints nearest_;
  std::vector<Eigen::Matrix4d> poses_;
  Eigen::Vector3d middle_;
  std::string verdict_;
  std::size_t pose_ = 0;
  bool is_before_, is_coloured_ = false;
  pcl::visualization::PCLVisualizer viewer_{"pcl_kss_icp"};
};

} // namespace

int
main(int argc, char** argv)
{
  if (argc == 2 && std::string(argv[1]) == "--help") {
    std::cout << USAGE;
    return 0;
  }
  if (argc != 4) {
    std::cerr << USAGE;
    return 2;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  try {
    const auto subject = [](const std::string& path, unsigned int seed) {
      return subjectOf(path, readGeometry(path), seed);
    };
    const nlohmann::json report = readReport(argv[3]);
    Window(subject(argv[1], 1), subject(argv[2], 2), report).run();
    return 0;
  }
  catch (const std::exception& problem) {
    std::cerr << "pcl_kss_icp_view: " << problem.what() << '\n';
  }
  return 2;
}
