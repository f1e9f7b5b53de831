/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "column_names.h"

#include "vector_field.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <set>
#include <stdexcept>

namespace tool {
namespace {

using Words = std::vector<std::string>;

/** The letters and digits of a title, in lower case, without the unit that stands in
 * brackets behind it, or another name behind a slash. */
std::string
keyOf(std::string title)
{
  if (const auto slash = title.find('/', 1); slash != std::string::npos)
    title.resize(slash);
  const auto bracket = title.find_first_of("[({", 1);
  if (bracket != std::string::npos)
    title.resize(bracket);
  std::string key;
  for (const unsigned char c : title)
    if (std::isalnum(c) && c < 0x80)
      key += static_cast<char>(std::tolower(c));
  return key;
}

/** Words with every prefix and every suffix. */
Words
compose(const Words& prefixes, const Words& words, const Words& suffixes)
{
  Words composed;
  for (const auto& prefix : prefixes)
    for (const auto& word : words)
      for (const auto& suffix : suffixes)
        composed.push_back(prefix + word + suffix);
  return composed;
}

/** What the three columns of a vector may be called, each by a set of words. */
using Naming = std::array<Words, 3>;

constexpr std::size_t NONE = -1;

/** The columns of a vector. */
using Columns = std::array<std::size_t, 3>;

std::size_t
find(const Words& keys, const Words& words)
{
  for (const auto& word : words) {
    const auto key = std::find(keys.begin(), keys.end(), word);
    if (key != keys.end())
      return static_cast<std::size_t>(key - keys.begin());
  }
  return NONE;
}

Columns
find(const Words& keys, const Naming& naming)
{
  return {find(keys, naming[0]), find(keys, naming[1]), find(keys, naming[2])};
}

bool
areComplete(const Columns& columns)
{
  return std::count(columns.begin(), columns.end(), NONE) == 0;
}

/** Names with an axis in them: by its letter, or by its number. */
Words
axisWords(std::size_t axis, const Words& prefixes, const Words& suffixes)
{
  return compose(prefixes, {std::string(1, "xyz"[axis])}, suffixes);
}

Words
numbered(std::size_t axis, const Words& prefixes, std::size_t first)
{
  return compose(prefixes, {std::to_string(axis + first)}, {""});
}

const Words POSITION_PREFIXES{"",           "p",           "pos",       "position",
                              "point",      "points",      "coord",     "coords",
                              "coordinate", "coordinates", "cartesian", "utm",
                              "world",      "xyz",         "location"};
const Words POSITION_SUFFIXES{
    "",  "coord", "coords", "coordinate", "coordinates", "pos",   "position",
    "m", "mm",    "cm",     "utm",        "koordinate",  "value", "location"};
const Words EAST{"easting", "eastings", "east", "eastingm", "rechtswert",
                 "ostwert", "este",     "est",  "ost"};
const Words NORTH{"northing", "northings", "north", "northingm",
                  "hochwert", "nordwert",  "norte", "nord"};
const Words HEIGHT{"height",  "elevation",  "elev",  "altitude", "alt",
                   "heightm", "elevationm", "hoehe", "hohe",     "hhe",
                   "cota",    "altura",     "quota", "hauteur"};

/** Words, and more of them. */
Words
with(Words words, const Words& more)
{
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/** All ways to name positions, the plainest first. None mixes two of them, for then the
 * columns need not be of one frame; but maps may have a height beside x and y. */
std::vector<Naming>
namingsOfPositions()
{
  std::vector<Naming> namings;
  for (const auto& prefix : POSITION_PREFIXES)
    for (const auto& suffix : POSITION_SUFFIXES)
      namings.push_back({Words{prefix + 'x' + suffix}, Words{prefix + 'y' + suffix},
                         Words{prefix + 'z' + suffix}});
  const Words heights = with(HEIGHT, {"h", "u", "up", "z"});
  namings.push_back({EAST, NORTH, HEIGHT});
  namings.push_back({EAST, NORTH, heights});
  for (const auto& suffix : POSITION_SUFFIXES)
    namings.push_back({Words{'x' + suffix}, Words{'y' + suffix}, with(HEIGHT, {"h"})});
  namings.push_back({with(EAST, {"e"}), with(NORTH, {"n"}), heights});
  const Words prefixes(POSITION_PREFIXES.begin() + 1, POSITION_PREFIXES.end());
  for (const std::size_t first : {0, 1})
    namings.push_back({numbered(0, prefixes, first), numbered(1, prefixes, first),
                       numbered(2, prefixes, first)});
  return namings;
}

/** What says that an elevation is an angle. */
bool
holdAngles(const Words& keys)
{
  return find(keys, {"azimuth", "bearing", "azimut"}) != NONE;
}

Columns
findPosition(const Words& keys)
{
  static const auto namings = namingsOfPositions();
  for (const auto& naming : namings) {
    const Columns found = find(keys, naming);
    if (areComplete(found) &&
        (!holdAngles(keys) || find({keys[found[2]]}, HEIGHT) == NONE))
      return found;
  }
  // three points of a triangle have an x1, too
  if (find(keys, {"y1", "z1"}) == NONE)
    return find(keys, Naming{Words{"x1"}, Words{"x2"}, Words{"x3"}});
  return {NONE, NONE, NONE};
}

/** Columns that may be x, y or z, though not of one naming, or not all three. */
Columns
findSomeOfPosition(const Words& keys)
{
  Naming naming{EAST, NORTH, holdAngles(keys) ? Words() : HEIGHT};
  for (std::size_t axis = 0; axis < 3; ++axis)
    naming[axis] =
        with(axisWords(axis, POSITION_PREFIXES, POSITION_SUFFIXES), naming[axis]);
  return find(keys, naming);
}

/** \throws std::runtime_error where titles name some of x, y and z, as those of a table
 * would and no prose does */
void
refuseSomeOfPosition(const Words& keys, const Words& titles)
{
  if (find(keys, {"lat", "latitude"}) != NONE &&
      find(keys, {"lon", "long", "lng", "longitude"}) != NONE)
    throw std::runtime_error("names latitude and longitude, which are angles; convert "
                             "them to x, y and z");
  const Columns columns = findSomeOfPosition(keys);
  std::string found;
  std::size_t count = 0;
  bool has_letter = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (columns[axis] != NONE) {
      found +=
          (count++ == 0 ? "'" : " and '") + titles[columns[axis]].substr(0, 40) + "'";
      has_letter = has_letter ||
                   find({keys[columns[axis]]},
                        axisWords(axis, POSITION_PREFIXES, POSITION_SUFFIXES)) != NONE;
    }
  if (count == 3)
    throw std::runtime_error("names " + found +
                             ", which are not of one kind; name x, y and z alike");
  if (count == 2 || has_letter)
    throw std::runtime_error("names " + found +
                             " alone of x, y and z; name all three columns");
}

Columns
findNormal(const Words& keys)
{
  const Words prefixes{"n", "normal", "normals", "norm", "nrm", "vn"};
  std::vector<Naming> namings(1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    namings[0][axis] = axisWords(axis, prefixes, {"", "component"});
    const Words behind = axisWords(axis, {""}, {"n", "normal"});
    namings[0][axis].insert(namings[0][axis].end(), behind.begin(), behind.end());
  }
  for (const std::size_t first : {0, 1})
    namings.push_back({numbered(0, prefixes, first), numbered(1, prefixes, first),
                       numbered(2, prefixes, first)});
  for (const auto& naming : namings) {
    const Columns found = find(keys, naming);
    if (areComplete(found))
      return found;
  }
  return {NONE, NONE, NONE};
}

Columns
findColour(const Words& keys)
{
  const Words prefixes{"", "color", "colour", "diffuse", "rgb"};
  std::vector<Naming> namings{{compose(prefixes, {"red", "r"}, {""}),
                               compose(prefixes, {"green", "g"}, {""}),
                               compose(prefixes, {"blue", "b"}, {""})}};
  for (const std::size_t first : {0, 1}) {
    const Words numbered_prefixes{"rgb", "color", "colors", "colour", "colours"};
    namings.push_back({numbered(0, numbered_prefixes, first),
                       numbered(1, numbered_prefixes, first),
                       numbered(2, numbered_prefixes, first)});
  }
  for (const auto& naming : namings) {
    const Columns found = find(keys, naming);
    if (areComplete(found))
      return found;
  }
  return {NONE, NONE, NONE};
}

/** A name without white space or what a header would take for a sign of its own. */
std::string
cleaned(std::string name, std::size_t column)
{
  for (auto& c : name)
    if (std::isspace(static_cast<unsigned char>(c)) || c == ',' || c == ';' ||
        c == '"' || std::iscntrl(static_cast<unsigned char>(c)))
      c = '_';
  constexpr std::size_t longest = 100;
  name.resize(std::min(name.size(), longest));
  return name.empty() || name == "_" ? "column_" + std::to_string(column + 1) : name;
}

} // namespace

std::vector<std::string>
fieldNames(const std::vector<std::string>& titles)
{
  Words keys;
  for (const auto& title : titles)
    keys.push_back(keyOf(title));
  const Columns position = findPosition(keys);
  if (!areComplete(position)) {
    refuseSomeOfPosition(keys, titles);
    return {};
  }

  std::vector<std::string> names(titles.size());
  std::set<std::string> taken;
  const auto give = [&](const Columns& columns, const std::array<const char*, 3>& as) {
    if (areComplete(columns))
      for (std::size_t i = 0; i < 3; ++i)
        if (names[columns[i]].empty() && taken.insert(as[i]).second)
          names[columns[i]] = as[i];
  };
  give(position, VectorField::POSITION);
  give(findNormal(keys), VectorField::NORMAL);
  const Columns colour = findColour(keys);
  give(colour, {"red", "green", "blue"});
  if (const std::size_t alpha = find(keys, {"alpha", "a"});
      areComplete(colour) && alpha != NONE && names[alpha].empty() &&
      taken.insert("alpha").second)
    names[alpha] = "alpha";
  for (std::size_t i = 0; i < titles.size(); ++i)
    if (names[i].empty()) {
      const std::string name = cleaned(titles[i], i);
      names[i] = name;
      for (int n = 2; !taken.insert(names[i]).second; ++n)
        names[i] = name + '_' + std::to_string(n);
    }
  return names;
}

} // namespace tool
