/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What the tool does of PCD files without PCL is what PCL does.
 */

#include "io/lzf.h"
#include "tool_files.h"

#include <pcl/io/lzf.h>
#include <pcl/io/pcd_io.h>

#include <random>

using namespace kss_test;

namespace {

using Bytes = std::vector<std::uint8_t>;

/** Bytes that repeat themselves near and far, once in a while or all the time. */
Bytes
repetitive(std::size_t size, unsigned int seed)
{
  std::mt19937 random(seed);
  Bytes bytes;
  while (bytes.size() < size)
    if (bytes.empty() || random() % 4 == 0)
      for (auto n = random() % 70; n > 0; --n)
        bytes.push_back(static_cast<std::uint8_t>(random() % (seed % 2 ? 256 : 3)));
    else {
      std::size_t at =
          bytes.size() - 1 - random() % std::min<std::size_t>(bytes.size(), 9000);
      for (auto n = random() % 400; n > 0; --n)
        bytes.push_back(bytes[at++]);
    }
  bytes.resize(size);
  return bytes;
}

/** As PCL compresses it; empty where that takes more room. */
Bytes
compressed(const Bytes& bytes)
{
  Bytes result(bytes.size() + bytes.size() / 16 + 64);
  result.resize(
      pcl::lzfCompress(bytes.data(), bytes.size(), result.data(), result.size()));
  return result;
}

std::string
headerByPCL(const Geometry& geometry)
{
  return pcl::PCDWriter().generateHeaderBinary(geometry.cloud, geometry.sensor_origin,
                                               geometry.sensor_orientation) +
         "DATA binary\n";
}

} // namespace

TEST_F(ToolFiles, PCDHeadersAreThoseOfPCL)
{
  Geometry geometry = fieldsOfAllKinds();
  geometry.sensor_origin << 1.5f, -2.0f, 1e-3f, 0.0f;
  geometry.sensor_orientation = Eigen::Quaternionf(0.5f, -0.5f, 0.5f, 0.5f);
  std::string header = headerByPCL(geometry);
  EXPECT_EQ(header, contentOf(write("a.pcd", geometry)).substr(0, header.size()));
  header = headerByPCL(farTetrahedron());
  EXPECT_EQ(header,
            contentOf(write("b.pcd", farTetrahedron())).substr(0, header.size()));

  // as in memory, with bytes between the fields and behind them
  pcl::toPCLPointCloud2(pcl::PointCloud<pcl::PointNormal>(2, 1), geometry.cloud);
  header = headerByPCL(geometry);
  EXPECT_NE(std::string::npos, header.find(" _ "));
  EXPECT_EQ(header, contentOf(write("c.pcd", geometry)).substr(0, header.size()));
}

/** Of which PCL writes headers that nobody can read. */
TEST_F(ToolFiles, PCDTakesFieldsInAnyOrder)
{
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud(2, 1);
  cloud[1].getVector3fMap() << 1.0f, 2.0f, 3.0f;
  cloud[1].getNormalVector3fMap() << 0.0f, 0.0f, 1.0f;
  cloud[1].r = 200;
  Geometry geometry;
  pcl::toPCLPointCloud2(cloud, geometry.cloud);
  const Geometry again = readGeometry(write("a.pcd", geometry));
  EXPECT_EQ(positionsOf(geometry), positionsOf(again));
  EXPECT_EQ(normalsOf(geometry), normalsOf(again));
  EXPECT_EQ(200, getColour(*findField(again.cloud, "rgb"),
                           &again.cloud.data[again.cloud.point_step])[0]);
}

TEST_F(ToolFiles, PCDKeepsWhereTheSensorStood)
{
  Geometry geometry = farTetrahedron();
  geometry.sensor_origin << 4512345.5f, -512345.25f, 1e-30f, 0.0f;
  EXPECT_EQ(geometry.sensor_origin,
            readGeometry(write("a.pcd", geometry)).sensor_origin);
}

TEST(LZF, DecompressesWhatPCLCompresses)
{
  for (unsigned int seed = 0; seed < 200; ++seed) {
    const Bytes bytes = repetitive(1 + 97 * seed, seed);
    const Bytes small = compressed(bytes);
    ASSERT_FALSE(small.empty()) << seed;
    Bytes again(bytes.size());
    EXPECT_TRUE(decompressLZF(small.data(), small.size(), again.data(), again.size()));
    EXPECT_EQ(bytes, again) << seed;
  }
}

TEST(LZF, RefusesWhatPCLRefuses)
{
  std::mt19937 random(1);
  int refused = 0;
  for (unsigned int seed = 0; seed < 2000; ++seed) {
    const Bytes bytes = repetitive(300, seed);
    Bytes small = compressed(bytes);
    if (seed % 2)
      small.resize(random() % small.size());
    else
      small[random() % small.size()] = static_cast<std::uint8_t>(random());
    Bytes ours(bytes.size()), theirs(bytes.size());
    const bool taken =
        decompressLZF(small.data(), small.size(), ours.data(), ours.size());
    EXPECT_EQ(!small.empty() &&
                  pcl::lzfDecompress(small.data(), small.size(), theirs.data(),
                                     theirs.size()) == theirs.size(),
              taken)
        << seed;
    if (taken) {
      EXPECT_EQ(theirs, ours) << seed;
    }
    refused += !taken;
  }
  EXPECT_GT(refused, 1000);
}
