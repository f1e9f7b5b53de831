/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// Writes scans of things whose poses are known, each in a frame of its own.

#include "scan_folder.h"
#include "virtual_sets.h"

#include <boost/program_options.hpp>

#include <iostream>
#include <stdexcept>

namespace po = boost::program_options;

namespace {

constexpr const char* usage =
    "Usage: pcl_kss_icp_virtual_scans WHAT [TRUTH...] --out DIR [options]\n\n"
    "Writes DIR/scan_000.pcd and so on, each in a frame of its own, and "
    "DIR/truth.json\n"
    "with the thing that each shows and the pose that maps it there. Metres.\n\n"
    "WHAT:\n"
    "  turntable  an object from all around, by a depth camera\n"
    "  building   rooms that doors connect, by a scanner on a tripod\n"
    "  hotel      the same, and each room fits on each other by its walls\n"
    "  loop       streets around a block of houses, by a lidar of 32 rings\n"
    "  street     a street and back on the other lane, by the same lidar\n"
    "  bag        five objects and two rooms of different plans, four to six scans of\n"
    "             each, shuffled\n"
    "  moved      the scans of truth files, moved: of {\"scans\": [{\"file\", "
    "\"thing\",\n"
    "             \"transformation\"}, ...]}; files of any format, beside the truth "
    "file;\n"
    "             scans without transformation are in the frame of their thing\n\n";

benchmarks::Turn
turnOf(const std::string& word)
{
  if (word == "none")
    return benchmarks::Turn::NONE;
  if (word == "yaw")
    return benchmarks::Turn::YAW;
  if (word == "any")
    return benchmarks::Turn::ANY;
  throw std::runtime_error("--turn is none, yaw or any, not \"" + word + '"');
}

benchmarks::VirtualScans
scansOf(const std::string& what, const po::variables_map& given)
{
  const unsigned int seed = given["seed"].as<unsigned int>();
  const std::size_t number = given["scans"].as<std::size_t>();
  const auto models = given["model"].as<std::vector<std::string>>();
  if (what == "turntable")
    return benchmarks::turntableScans(models, number, seed);
  if (what == "building")
    return benchmarks::buildingScans(benchmarks::Rooms::DIFFERENT, number, seed);
  if (what == "hotel")
    return benchmarks::buildingScans(benchmarks::Rooms::EQUAL, number, seed);
  if (what == "loop")
    return benchmarks::loopScans(number, seed);
  if (what == "street")
    return benchmarks::streetScans(number, seed);
  if (what == "bag")
    return benchmarks::bagScans(models, seed);
  if (what != "moved")
    throw std::runtime_error("nothing is known of \"" + what +
                             "\"; --help shows what there is");
  benchmarks::VirtualScans all;
  for (const std::string& truth : given["truth"].as<std::vector<std::string>>())
    for (benchmarks::VirtualScan& scan : benchmarks::readScans(truth))
      all.push_back(std::move(scan));
  return all;
}

using Words = std::vector<std::string>;

po::options_description
visibleOptions()
{
  po::options_description options("Options");
  // clang-format off
  options.add_options()
    ("out", po::value<std::string>()->value_name("DIR"), "the folder to write")
    ("seed", po::value<unsigned int>()->default_value(1), "another thing, other noise "
     "and other frames with every seed")
    ("scans", po::value<std::size_t>()->default_value(0)->value_name("N"),
     "how many; 0: as many as it takes")
    ("model", po::value<Words>()->default_value({}, "")->value_name("FILE"),
     "a mesh in place of each object that is made up; it becomes 0.2 m large")
    ("turn", po::value<std::string>()->value_name("WORD"),
     "the frames: none, yaw (turned about the vertical: what lidars get by default), "
     "any (turned about any axis, and moved: what all others get)")
    ("shuffle", "write the scans in an order that tells nothing; a bag always is")
    ("help,h", "show this help");
  // clang-format on
  return options;
}

po::variables_map
parsed(int argc, char** argv)
{
  po::options_description all = visibleOptions();
  // clang-format off
  all.add_options()
    ("what", po::value<std::string>())
    ("truth", po::value<Words>()->default_value({}, ""));
  // clang-format on
  po::positional_options_description order;
  order.add("what", 1).add("truth", -1);
  po::variables_map given;
  po::store(po::command_line_parser(argc, argv).options(all).positional(order).run(),
            given);
  po::notify(given);
  return given;
}

int
run(int argc, char** argv)
{
  const po::variables_map given = parsed(argc, argv);
  if (given.count("help") > 0) {
    std::cout << usage << visibleOptions();
    return 0;
  }
  if (given.count("what") == 0 || given.count("out") == 0)
    throw std::runtime_error("say what to scan, and --out DIR; --help shows all");

  const auto what = given["what"].as<std::string>();
  const auto seed = given["seed"].as<unsigned int>();
  const bool is_lidar = what == "loop" || what == "street";
  benchmarks::VirtualScans scans = scansOf(what, given);
  benchmarks::move(scans,
                   given.count("turn") > 0 ? turnOf(given["turn"].as<std::string>())
                   : is_lidar              ? benchmarks::Turn::YAW
                                           : benchmarks::Turn::ANY,
                   seed + 1000);
  if (what == "bag" || given.count("shuffle") > 0)
    benchmarks::shuffle(scans, seed + 2000);
  benchmarks::writeScans(scans, given["out"].as<std::string>());
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  try {
    return run(argc, argv);
  }
  catch (const std::exception& error) {
    std::cerr << "pcl_kss_icp_virtual_scans: " << error.what() << '\n';
    return 2;
  }
}
