/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "format_readers.h"
#include "numbers.h"
#include "text_lines.h"
#include "vector_field.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

/** \file
 * Assimp 5.2 leaves out what it does not understand, without a word, and all points
 * that no face uses; and it opens the files of materials, which may be anything.
 */

namespace tool {
namespace {

/** What may stand in a file and says nothing about points and faces. */
bool
isOtherStatement(std::string_view keyword)
{
  static const std::set<std::string_view> keywords{
      "g",        "o",          "s",         "mg",    "usemtl", "mtllib",
      "usemap",   "maplib",     "l",         "p",     "vt",     "vp",
      "bevel",    "c_interp",   "lod",       "ctech", "stech",  "cstype",
      "d_interp", "shadow_obj", "trace_obj", "deg",   "bmat",   "step",
      "curv",     "curv2",      "surf",      "parm",  "trim",   "hole",
      "scrv",     "sp",         "end",       "con",   "call",   "csh"};
  return keywords.count(keyword) > 0;
}

constexpr std::size_t NONE = -1;

struct Point {
  Eigen::Vector3d position;
  /** Red, green and blue; none where the first is negative. */
  Eigen::Vector3d colour;
  /** The number of its normal. */
  std::size_t normal;
};

struct Corner {
  std::size_t point, normal;
};

struct Face {
  std::size_t line;
  std::vector<Corner> corners;
};

/** The points and faces of a file. */
class Mesh {
public:
  explicit Mesh(std::istream& stream)
  : lines_(stream, TextLines::Style::COMMENTED)
  {
    while (lines_.next()) {
      while (lines_.text().back() == '\\')
        lines_.join();
      readStatement();
    }
    // points alone have their normals in the same order
    if (faces_.empty() && statements_.normals.size() == points_.size())
      for (std::size_t i = 0; i < points_.size(); ++i)
        points_[i].normal = i;
    checkFaces();
  }

  Geometry
  geometry()
  {
    Geometry geometry;
    geometry.faces = joinNormals();
    const bool has_normals = std::any_of(
        points_.begin(), points_.end(), [](const auto& p) { return p.normal != NONE; });
    const bool has_colours = std::any_of(
        points_.begin(), points_.end(), [](const auto& p) { return p.colour[0] >= 0; });
    geometry.from_text = true;
    auto& cloud = geometry.cloud;
    for (const char* name : VectorField::POSITION)
      addField(cloud, name, pcl::PCLPointField::FLOAT64);
    if (has_normals)
      for (const char* name : VectorField::NORMAL)
        addField(cloud, name, pcl::PCLPointField::FLOAT64);
    if (has_colours)
      addField(cloud, "rgba", pcl::PCLPointField::UINT32);
    setNumberOfPoints(cloud, points_.size());

    const VectorField position(cloud, VectorField::POSITION);
    const VectorField normal(cloud, VectorField::NORMAL);
    const auto* colour = findField(cloud, "rgba");
    const double white = haveByteColours() ? 255.0 : 1.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      std::uint8_t* to = &cloud.data[i * cloud.point_step];
      position.set(to, points_[i].position);
      if (points_[i].normal != NONE)
        normal.set(to, statements_.normals[points_[i].normal]);
      if (!colour)
        continue;
      to[colour->offset + 3] = 255;
      for (int k = 0; k < 3; ++k) { // blue first; white where only others have a colour
        const double part = points_[i].colour[0] < 0 ? white : points_[i].colour[2 - k];
        to[colour->offset + k] =
            static_cast<std::uint8_t>(std::lround(255.0 * std::min(part / white, 1.0)));
      }
    }
    geometry.statements = std::move(statements_);
    return geometry;
  }

private:
  /** Whether colours go up to 255, as some programs write them, and not up to 1. */
  bool
  haveByteColours() const
  {
    const auto is_byte = [](const Point& point) {
      return point.colour[0] < 0 ||
             (point.colour == point.colour.array().round().matrix() &&
              point.colour.maxCoeff() <= 255.0);
    };
    return std::any_of(points_.begin(), points_.end(),
                       [](const auto& p) { return p.colour.maxCoeff() > 1.0; }) &&
           std::all_of(points_.begin(), points_.end(), is_byte);
  }

  void
  readStatement()
  {
    const auto& words = lines_.words();
    const std::string_view keyword = words.empty() ? "" : words[0];
    if (keyword == "v" && words.size() == 7) // with all digits of its colour
      statements_.text.append("v ").append(words[4].data()) += '\n';
    else if (keyword == "v" || keyword == "vn")
      statements_.text.append(keyword) += '\n';
    else if (!keyword.empty())
      statements_.text.append(lines_.text()) += '\n';
    if (keyword == "v")
      addPoint();
    else if (keyword == "vn")
      statements_.normals.push_back(toVector(numbers({3})));
    else if (keyword == "f" || keyword == "fo")
      addFace();
    else if (isOtherStatement(keyword))
      addOther(std::string(keyword));
    else if (!keyword.empty())
      lines_.failAt(keyword, "is no keyword of OBJ");
  }

  /** Remember what other formats cannot hold. */
  void
  addOther(const std::string& keyword)
  {
    static const std::map<std::string, std::string> names{{"vt", "texture coordinates"},
                                                          {"usemtl", "materials"},
                                                          {"mtllib", "materials"},
                                                          {"g", "groups"},
                                                          {"o", "objects"},
                                                          {"s", "smoothing groups"},
                                                          {"l", "lines"},
                                                          {"p", "point elements"}};
    const auto name = names.find(keyword);
    auto& others = statements_.others;
    std::string other = name == names.end() ? "'" + keyword + "'" : name->second;
    if (std::find(others.begin(), others.end(), other) == others.end())
      others.push_back(std::move(other));
  }

  static Eigen::Vector3d
  toVector(const std::vector<double>& numbers)
  {
    return {numbers[0], numbers[1], numbers[2]};
  }

  /** The numbers of the line, as many as one of those. */
  const std::vector<double>&
  numbers(std::initializer_list<std::size_t> allowed)
  {
    const auto& numbers = lines_.numbers(1);
    if (std::count(allowed.begin(), allowed.end(), numbers.size()) == 0)
      lines_.fail("has " + std::to_string(numbers.size()) +
                  " numbers, which is not a point like x y z or x y z r g b, nor a "
                  "normal; the file is damaged or incomplete");
    return numbers;
  }

  void
  addPoint()
  {
    const auto& numbers = this->numbers({3, 4, 6});
    Point point{toVector(numbers), Eigen::Vector3d::Constant(-1.0), NONE};
    if (numbers.size() == 4) { // homogeneous
      if (numbers[3] == 0.0)
        lines_.fail("the point lies at infinity");
      point.position /= numbers[3];
    }
    if (numbers.size() == 6) {
      for (std::size_t i = 3; i < 6; ++i) {
        if (!std::isfinite(numbers[i]))
          lines_.fail("has a colour that is no number");
        point.colour[i - 3] = std::max(numbers[i], 0.0);
      }
    }
    points_.push_back(point);
  }

  /** The number of a point or normal, counted from 0, by the word in the file. */
  std::size_t
  indexOf(std::string_view word, std::size_t number) const
  {
    std::int64_t index;
    if (!parseNumber(word, index))
      lines_.failAt(word, "is not the number of a point or normal");
    const auto count = static_cast<std::int64_t>(number);
    if (index == 0 || index < -count)
      lines_.failAt(word, "refers to a point or normal that is not there");
    return static_cast<std::size_t>(index > 0 ? index - 1 : count + index);
  }

  void
  addFace()
  {
    const auto& words = lines_.words();
    if (words.size() < 4)
      lines_.fail("a face has fewer than three corners; the file is damaged or "
                  "incomplete");
    Face face{lines_.number(), {}};
    for (std::size_t i = 1; i < words.size(); ++i) {
      // point, point/texture, point//normal or point/texture/normal
      const std::string_view word = words[i];
      const auto first = std::min(word.find('/'), word.size());
      const auto second = std::min(word.find('/', first + 1), word.size());
      Corner corner{indexOf(word.substr(0, first), points_.size()), NONE};
      if (second + 1 < word.size())
        corner.normal = indexOf(word.substr(second + 1), statements_.normals.size());
      face.corners.push_back(corner);
    }
    faces_.push_back(face);
  }

  /** Points may come after the faces that they are corners of. */
  void
  checkFaces() const
  {
    for (const auto& face : faces_)
      for (const auto& corner : face.corners)
        if (corner.point >= points_.size() ||
            (corner.normal != NONE && corner.normal >= statements_.normals.size()))
          throw std::runtime_error("line " + std::to_string(face.line) +
                                   ": a face refers to a point or normal that is not "
                                   "there");
  }

  /** Give each point the normal that its corners have; points with several normals
   * become several points. */
  std::vector<pcl::Vertices>
  joinNormals()
  {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> more;
    std::vector<pcl::Vertices> faces;
    for (const auto& face : faces_) {
      faces.emplace_back();
      for (const auto& corner : face.corners) {
        std::size_t index = corner.point;
        if (points_[index].normal == NONE)
          points_[index].normal = corner.normal;
        else if (corner.normal != NONE && points_[index].normal != corner.normal) {
          const auto place =
              more.emplace(std::make_pair(index, corner.normal), points_.size());
          if (place.second) {
            points_.push_back(points_[index]);
            points_.back().normal = corner.normal;
          }
          index = place.first->second;
        }
        faces.back().vertices.push_back(static_cast<pcl::index_t>(index));
      }
    }
    return faces;
  }

  TextLines lines_;
  std::vector<Point> points_;
  OBJStatements statements_;
  std::vector<Face> faces_;
};

} // namespace

Geometry
readOBJ(std::istream& stream)
{
  return Mesh(stream).geometry();
}

} // namespace tool
