/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "file_format.h"
#include "format_readers.h"
#include "vector_field.h"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace tool {
namespace {

/** The last part of a file. */
std::string
tailOf(std::ifstream& stream)
{
  constexpr std::streamoff LENGTH = 1000;
  stream.seekg(0, std::ios::end);
  stream.seekg(std::max<std::streamoff>(0, stream.tellg() - LENGTH));
  std::ostringstream tail;
  tail << stream.rdbuf();
  return tail.str();
}

/** The only sign of an incomplete OBJ file is a last line that is cut short. */
bool
isCompleteOBJ(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  const std::string tail = tailOf(stream);
  std::istringstream words(tail.substr(tail.rfind('\n') + 1));
  std::string key, word;
  words >> key;
  int arguments = 0;
  while (words >> word)
    ++arguments;
  return (key != "v" && key != "vn" && key != "f") || arguments >= 3;
}

bool
isCompleteSTL(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  constexpr std::uint64_t HEADER = 84, TRIANGLE = 50;
  char header[HEADER] = {};
  stream.read(header, HEADER);
  std::uint32_t triangles; // the last number of a binary header
  std::memcpy(&triangles, header + HEADER - sizeof triangles, sizeof triangles);
  if (std::filesystem::file_size(path) == HEADER + TRIANGLE * triangles)
    return true;
  stream.clear();
  return tailOf(stream).find("endsolid") != std::string::npos; // the end of a text
}

/** Whether all meshes have a part, so that all points of their cloud can have it. */
template <typename Predicate>
bool
allMeshes(const aiScene& scene, Predicate predicate)
{
  return std::all_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes, predicate);
}

std::uint32_t
packed(const aiColor4D& colour)
{
  const auto byte = [](float part) {
    return static_cast<std::uint32_t>(
        std::lround(255.0f * std::min(std::max(part, 0.0f), 1.0f)));
  };
  return byte(colour.a) << 24 | byte(colour.r) << 16 | byte(colour.g) << 8 |
         byte(colour.b);
}

Eigen::Vector3d
toEigen(const aiVector3D& vector)
{
  return {vector.x, vector.y, vector.z};
}

/** Add a mesh whose points are numbered from \a first_point. */
void
append(const aiMesh& mesh, std::size_t first_point, Geometry& geometry)
{
  auto& cloud = geometry.cloud;
  const VectorField position(cloud, VectorField::POSITION);
  const VectorField normal(cloud, VectorField::NORMAL);
  const bool has_normals = normal.exists();
  const auto* colour = findField(cloud, "rgba");
  for (unsigned int i = 0; i < mesh.mNumVertices; ++i) {
    std::uint8_t* point = &cloud.data[(first_point + i) * cloud.point_step];
    position.set(point, toEigen(mesh.mVertices[i]));
    if (has_normals)
      normal.set(point, toEigen(mesh.mNormals[i]));
    if (colour) {
      const std::uint32_t value = packed(mesh.mColors[0][i]);
      std::memcpy(point + colour->offset, &value, sizeof value);
    }
  }
  for (unsigned int i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3)
      continue; // a point or a line
    pcl::Vertices vertices;
    for (unsigned int k = 0; k < face.mNumIndices; ++k)
      vertices.vertices.push_back(first_point + face.mIndices[k]);
    geometry.faces.push_back(vertices);
  }
}

} // namespace

Geometry
readWithAssimp(const std::string& path)
{
  const bool is_stl = fileFormatOf(path) == FileFormat::STL;
  if (is_stl ? !isCompleteSTL(path) : !isCompleteOBJ(path))
    throw std::runtime_error("the file is damaged or incomplete");

  // The normals of STL belong to triangles and would keep their corners apart.
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS);
  unsigned int steps = aiProcess_JoinIdenticalVertices;
  if (is_stl)
    steps |= aiProcess_RemoveComponent;
  const aiScene* scene = importer.ReadFile(path, steps);
  if (!scene)
    throw std::runtime_error(std::string("cannot be read: ") +
                             importer.GetErrorString());

  Geometry geometry;
  auto& cloud = geometry.cloud;
  for (const char* name : VectorField::POSITION)
    addField(cloud, name, pcl::PCLPointField::FLOAT32);
  if (allMeshes(*scene, [](const aiMesh* mesh) { return mesh->HasNormals(); }))
    for (const char* name : VectorField::NORMAL)
      addField(cloud, name, pcl::PCLPointField::FLOAT32);
  if (allMeshes(*scene, [](const aiMesh* mesh) { return mesh->HasVertexColors(0); }))
    addField(cloud, "rgba", pcl::PCLPointField::UINT32);

  std::size_t points = 0;
  for (unsigned int i = 0; i < scene->mNumMeshes; ++i)
    points += scene->mMeshes[i]->mNumVertices;
  setNumberOfPoints(cloud, points);
  points = 0;
  for (unsigned int i = 0; i < scene->mNumMeshes; ++i) {
    append(*scene->mMeshes[i], points, geometry);
    points += scene->mMeshes[i]->mNumVertices;
  }
  return geometry;
}

} // namespace tool
