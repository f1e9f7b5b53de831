/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "journal.h"

#include "command_line/report.h"
#include "command_line/signals.h"

#include <cstring>

namespace tool {

using JSON = nlohmann::ordered_json;

Journal::Journal(const std::string& path, const JSON& run, std::size_t pairs, bool anew)
: file_(path, run, anew)
, places_(pairs, NOWHERE)
, deaths_(pairs, 0)
{
  std::set<std::size_t> running;
  file_.read([&](const std::string& text, std::uint64_t place) {
    const JSON line = JSON::parse(text, nullptr, false);
    if (line.is_object())
      take(line, place, running);
    else
      ++damaged_; // what it told of is done again
  });
  for (const std::size_t pair : running)
    ++deaths_[pair];
  file_.append(textOf({{"start", true}}, -1));
  setLastWords({file_.descriptor(), END, SAME_COMMAND_GOES_ON});
}

Journal::~Journal()
{
  setLastWords({});
  try {
    file_.append(std::string(END, std::strlen(END) - 1));
  }
  catch (const std::exception&) {
    // pairs that were running are suspected for nothing
  }
}

void
Journal::take(const JSON& line, std::uint64_t place, std::set<std::size_t>& running)
{
  const auto numberAt = [&](const char* key) {
    const auto found = line.find(key);
    const std::size_t pair = found != line.end() && found->is_number_unsigned()
                                 ? found->get<std::size_t>()
                                 : 0;
    return pair <= places_.size() ? pair : 0;
  };
  if (line.contains("ended"))
    running.clear();
  else if (line.contains("start")) {
    for (const std::size_t pair : running)
      ++deaths_[pair];
    running.clear();
  }
  else if (const std::size_t begun = numberAt("begun"))
    running.insert(begun - 1);
  else if (const std::size_t done = numberAt("done")) {
    running.erase(done - 1);
    done_ += isDone(done - 1) ? 0 : 1;
    places_[done - 1] = place;
  }
}

void
Journal::noteBegun(std::size_t pair)
{
  file_.append(textOf({{"begun", pair + 1}}, -1));
}

void
Journal::noteDone(std::size_t pair, const JSON& answer)
{
  JSON line{{"done", pair + 1}};
  line.update(answer);
  places_[pair] = file_.append(textOf(line, -1));
  ++done_;
}

void
Journal::forget(std::size_t pair)
{
  places_[pair] = NOWHERE;
  --done_;
}

JSON
Journal::operator[](std::size_t pair) const
{
  const JSON line = JSON::parse(file_.lineAt(places_.at(pair)), nullptr, false);
  if (!line.is_object() || line.value("done", std::size_t(0)) != pair + 1)
    file_.fail("has changed while it was in use; start again");
  return line;
}

} // namespace tool
