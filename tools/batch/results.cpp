/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "results.h"

#include "command_line/output_file.h"
#include "command_line/report.h"
#include "csv.h"
#include "pair_answer.h"

#include <functional>
#include <ostream>

namespace tool {
namespace {

using JSON = nlohmann::ordered_json;

void
writeTable(std::ostream& table, std::size_t number, const Pair& pair, const JSON& line)
{
  table << number << ',' << asField(pair.name) << ',' << asField(pair.source) << ','
        << asField(pair.target) << ',' << line.at("status").get<std::string>() << ','
        << line.at("row").get<std::string>() << '\n';
}

void
writeReport(std::ostream& reports,
            std::size_t number,
            const Pair& pair,
            const JSON& line)
{
  JSON report{{"number", number}, {"name", pair.name}, {"status", line.at("status")}};
  report.update(line.at("report"));
  reports << textOf(report, -1) << '\n';
}

void
writeTime(std::ostream& times, std::size_t number, const Pair& pair, const JSON& line)
{
  const JSON& seconds = line.at("seconds");
  times << number << ',' << asField(pair.name) << ','
        << (seconds.is_number() ? seconds.dump() : "") << '\n';
}

} // namespace

Counts
writeResults(const std::string& folder,
             const Manifest& manifest,
             const Journal& journal)
{
  OutputFile table(folder + '/' + TABLE_FILE), reports(folder + '/' + REPORTS_FILE),
      times(folder + '/' + TIMES_FILE);
  Counts counts;
  using Writer = void(std::ostream&, std::size_t, const Pair&, const JSON&);
  const auto write = [&](OutputFile& file, const std::string& header, Writer& writer) {
    file.write([&](std::ostream& stream) {
      stream << header;
      for (std::size_t i = 0; i < manifest.size() && stream; ++i)
        writer(stream, i + 1, manifest[i], journal[i]);
    });
  };
  write(table, "number,name,source,target,status," + rowHeader() + '\n', writeTable);
  write(reports, "", writeReport);
  write(times, "number,name,seconds\n", writeTime);
  for (std::size_t i = 0; i < manifest.size(); ++i)
    ++counts[journal[i].at("status").get<std::string>()];

  const SignalsHeld held;
  for (OutputFile* file : {&table, &reports, &times})
    file->putInPlace();
  return counts;
}

} // namespace tool
