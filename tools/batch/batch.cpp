/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "batch.h"

#include "command_line/quantities.h"
#include "command_line/report.h"
#include "pair_answer.h"
#include "results.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace tool {
namespace {

namespace fs = std::filesystem;

using JSON = nlohmann::ordered_json;

/** In so many starts a pair may end the program before it is passed over. */
constexpr unsigned int MOST_DEATHS = 3;

constexpr const char* JOURNAL_FILE = "journal.jsonl";

/** What all pairs are done with: results of two such runs do not go together. */
JSON
runOf(const BatchOptions& options, const Manifest& manifest)
{
  JSON settings = settingsAsJSON(options.how);
  settings.erase("guess"); // each pair has its own
  return {{"version", PCL_KSS_ICP_VERSION},
          {"manifest", {manifest.bytes(), manifest.checksum()}},
          {"settings", settings}};
}

} // namespace

Batch::Batch(const BatchOptions& options)
: options_(options)
, manifest_(options.manifest)
, manifest_folder_(fs::path(options.manifest).parent_path().string())
{
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (error || !fs::is_directory(options.folder))
    throw std::runtime_error(options.folder + ": cannot be made a folder" +
                             (error ? ": " + error.message() : ""));
  for (const char* name : {TABLE_FILE, REPORTS_FILE, TIMES_FILE, JOURNAL_FILE})
    if (fs::equivalent(options.manifest, fs::path(options.folder) / name, error))
      throw std::runtime_error(options.manifest + ": is a file that results in " +
                               options.folder + " would replace; rename it, or give " +
                               "--out another folder");
  journal_.emplace(options.folder + '/' + JOURNAL_FILE, runOf(options, manifest_),
                   manifest_.size(), options.restart);
  checkDone();
}

void
Batch::checkDone()
{
  for (std::size_t i = 0; i < manifest_.size(); ++i) {
    if (!journal_->isDone(i))
      continue;
    const Pair pair = manifest_[i];
    const JSON line = (*journal_)[i];
    if (line.at("status") == FAILED_PAIR && line.at("seconds").is_number())
      journal_->forget(i);
    else if (line.at("inputs") != stateOfInputs(pair, manifest_folder_))
      throw std::runtime_error(
          options_.folder + ": the files of pair " + std::to_string(i + 1) + " (" +
          pair.source + ", " + pair.target +
          ") have changed since it was done; --restart begins anew, and another folder "
          "for --out keeps what there is");
  }
}

void
Batch::run(Crew& crew)
{
  progress_.emplace(manifest_.size(), journal_->numberDone(), options_.quiet);
  if (journal_->numberDone() > 0 && !options_.quiet)
    std::cerr << journal_->numberDone() << " of " << manifest_.size()
              << " pairs are done already\n";
  if (journal_->numberDamaged() > 0 && !options_.quiet)
    std::cerr << "warning: " << counted(journal_->numberDamaged(), "line")
              << " of the journal cannot be read: what they told of is done again\n";
  runSuspects(crew);
  // by number: they may be too many for more than that
  std::vector<std::size_t> pairs;
  for (std::size_t i = 0; i < manifest_.size(); ++i)
    if (!journal_->isDone(i))
      pairs.push_back(i);
  run(crew, pairs);
}

void
Batch::runSuspects(Crew& crew)
{
  for (std::size_t i = 0; i < manifest_.size(); ++i)
    if (journal_->isDone(i))
      continue;
    else if (journal_->deaths(i) >= MOST_DEATHS) {
      journal_->noteDone(
          i, failedPair(manifest_[i], manifest_folder_,
                        "the program was ended while it did this pair, in " +
                            std::to_string(journal_->deaths(i)) +
                            " starts: it is passed over"));
      progress_->step();
    }
    else if (journal_->deaths(i) + 1 == MOST_DEATHS)
      run(crew, {i});
}

void
Batch::run(Crew& crew, const std::vector<std::size_t>& pairs)
{
  crew.run(
      pairs.size(),
      [&](std::size_t i) {
        journal_->noteBegun(pairs[i]);
        return jobOf(manifest_[pairs[i]], manifest_folder_);
      },
      [&](std::size_t i, const JobAnswer& answer) { keep(pairs[i], answer); });
}

void
Batch::keep(std::size_t pair, const JobAnswer& answer)
{
  journal_->noteDone(
      pair, answer.failure.empty()
                ? JSON::parse(answer.bytes)
                : failedPair(manifest_[pair], manifest_folder_, answer.failure));
  progress_->step();
}

bool
Batch::conclude()
{
  const std::string pace = progress_->pace();
  progress_.reset(); // the bar goes away
  manifest_.checkUnchanged();
  Counts counts = writeResults(options_.folder, manifest_, *journal_);
  if (!options_.quiet) {
    std::cout << counted(manifest_.size(), "pair") << ':';
    const char* comma = " ";
    for (const char* status : {REGISTERED, AMBIGUOUS, REFUSED, FAILED_PAIR}) {
      std::cout << comma << counts[status] << ' ' << status;
      comma = ", ";
    }
    std::cout << "; " << pace << '\n'
              << (fs::path(options_.folder) / TABLE_FILE).string()
              << " tells of each\n";
  }
  return counts[REFUSED] + counts[FAILED_PAIR] == 0;
}

} // namespace tool
