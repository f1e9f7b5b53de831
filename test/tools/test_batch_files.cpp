/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The files of a batch: the list of pairs, and the journal of what is done.
 */

#include "own_folder.h"

#include "batch/csv.h"
#include "batch/journal.h"
#include "batch/manifest.h"

#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace tool;

class BatchFiles : public kss_test::OwnFolder {
protected:
  /** \brief The pairs of a manifest, each as its words with bars between them. */
  std::vector<std::string>
  pairs(const std::string& content) const
  {
    const Manifest manifest(write("pairs", content));
    std::vector<std::string> all;
    for (std::size_t i = manifest.size(); i-- > 0;) { // in any order
      const Pair pair = manifest[i];
      all.insert(all.begin(),
                 pair.source + '|' + pair.target + '|' + pair.name + '|' + pair.guess);
    }
    return all;
  }

  /** \brief What is said of a manifest that is wrong. */
  std::string
  refusal(const std::string& content) const
  {
    try {
      pairs(content);
    }
    catch (const std::runtime_error& problem) {
      const std::string text = problem.what();
      EXPECT_EQ(0u, text.find(path("pairs") + ": ")) << text;
      return text;
    }
    return "";
  }

  std::unique_ptr<Journal>
  journal(const std::string& settings = "a", bool anew = false) const
  {
    return std::make_unique<Journal>(
        path("journal"), nlohmann::ordered_json{{"settings", settings}}, 4, anew);
  }

  std::string
  content(const std::string& name) const
  {
    std::ostringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }
};

using Lines = std::vector<std::string>;

TEST_F(BatchFiles, CSV)
{
  EXPECT_EQ((Lines{"a.ply|b.ply||", "c.ply|d.ply||"}),
            pairs("source,target\na.ply,b.ply\nc.ply,d.ply\n"));
  EXPECT_EQ((Lines{"a|b|first|g.txt", "c|d||"}),
            pairs("name,guess, target ,source\nfirst,g.txt,b,a\n,,d,c"));
}

TEST_F(BatchFiles, OtherLineEndsAndByteOrderMarks)
{
  EXPECT_EQ((Lines{"a|b||", "c|d||"}),
            pairs("\xEF\xBB\xBFsource,target\r\na,b\r\n\r\nc,d\r\n\r\n"));
}

TEST_F(BatchFiles, QuotedFields)
{
  EXPECT_EQ((Lines{"a, b.ply|say \"hi\"|two\nlines|", "c|d||"}),
            pairs("source,target,name\n"
                  "\"a, b.ply\",\"say \"\"hi\"\"\",\"two\nlines\"\n"
                  "\"c\",d,\"\"\n"));
  for (const std::string field : {"plain", "a,b", "a\"b", "two\nlines", "\"", "", "\r"})
    EXPECT_EQ((Lines{field, "x"}), fieldsOf(asField(field) + ",x"));
}

TEST_F(BatchFiles, JSONLines)
{
  EXPECT_EQ((Lines{"a|b|\"n\"|", "c|d||g"}),
            pairs("{\"source\": \"a\", \"target\": \"b\", \"name\": \"\\\"n\\\"\"}\n\n"
                  "{\"target\": \"d\", \"source\": \"c\", \"guess\": \"g\"}"));
}

TEST_F(BatchFiles, AllMistakesAreToldWithTheirLines)
{
  const std::string csv = refusal("source,target\na,b\n\na\n,b\na,\n\"a,b\n");
  for (const std::string part :
       {"line 4: has 1 field, but there are 2 columns", "line 5: names no source",
        "line 6: names no target", "line 7: a quote is not closed"})
    EXPECT_NE(std::string::npos, csv.find(part)) << csv;
  EXPECT_NE(std::string::npos,
            refusal("source,target\n\"a\"b,c\n").find("line 2: a comma is missing"));
  EXPECT_NE(std::string::npos,
            refusal("source,target,name\na,b,\"two\nlines\"\na\"b,c,d\"\n")
                .find("line 4: a field with quotes"));

  const std::string json =
      refusal("{\"source\":\"a\",\"target\":\"b\"}\n{\"source\":1}\n"
              "nonsense\n{\"source\":\"a\"}\n{\"sorce\":\"a\"}\n");
  for (const std::string part :
       {"line 2: 'source' is no string", "line 3: is no JSON object",
        "line 4: names no target", "line 5: there is no column 'sorce'"})
    EXPECT_NE(std::string::npos, json.find(part)) << json;
  EXPECT_EQ(std::string::npos, json.find('\n')) << "messages are lines";
}

TEST_F(BatchFiles, FilesThatAreNoLists)
{
  EXPECT_NE(std::string::npos,
            refusal("[{\"source\":\"a\",\"target\":\"b\"}]\n").find("is a JSON list"));
  for (const std::string mark : {"\xFF\xFE", "\xFE\xFF"})
    EXPECT_NE(std::string::npos, refusal(mark + "source").find("is in UTF-16"));
  // what is told apart by zeros between processes
  EXPECT_NE(std::string::npos, refusal("{\"source\":\"a\\u0000b\",\"target\":\"c\"}\n")
                                   .find("line 1: has a zero byte in its source"));
}

TEST_F(BatchFiles, HeadersThatAreWrong)
{
  EXPECT_NE(std::string::npos, refusal("source,name\na,b\n")
                                   .find("line 1, which names the columns: lacks "
                                         "'target'"));
  EXPECT_NE(std::string::npos, refusal("source;target\na;b\n").find("no column"));
  EXPECT_NE(std::string::npos,
            refusal("source,target,source\na,b,c\n").find("is there twice"));
  for (const std::string empty : {"", "\n\n", "source,target\n"})
    EXPECT_NE(std::string::npos, refusal(empty).find("holds no pairs")) << empty;
  EXPECT_THROW(Manifest(path("none")), std::runtime_error);
  EXPECT_THROW(Manifest(directory_.string()), std::runtime_error);
}

TEST_F(BatchFiles, ManifestsThatChange)
{
  write("pairs", "source,target\na,b\n");
  const Manifest manifest(path("pairs"));
  EXPECT_NO_THROW(manifest.checkUnchanged());
  write("pairs", "source,target\na,c\n");
  EXPECT_THROW(manifest.checkUnchanged(), std::runtime_error);
  EXPECT_NE(manifest.checksum(), Manifest(path("pairs")).checksum());
}

TEST_F(BatchFiles, JournalsKeepWhatIsDone)
{
  for (const int start : {0, 1}) {
    const auto kept = journal();
    EXPECT_EQ(start == 1, kept->isDone(2));
    EXPECT_EQ(start == 1 ? 1u : 0u, kept->numberDone());
    if (start == 0) {
      kept->noteBegun(2);
      kept->noteDone(2, {{"status", "registered"}});
    }
    EXPECT_EQ("registered", (*kept)[2].at("status"));
    EXPECT_FALSE(kept->isDone(1));
    EXPECT_THROW((*kept)[1], std::exception);
  }
  EXPECT_FALSE(journal("a", true)->isDone(2));
}

TEST_F(BatchFiles, JournalsWithATornLine)
{
  {
    const auto kept = journal();
    kept->noteDone(0, {{"status", "registered"}});
    kept->noteDone(1, {{"status", "refused"}});
  }
  const std::string whole = content("journal");
  const std::size_t second = whole.find("{\"done\":2");
  for (std::size_t length = second; length < whole.size(); ++length) {
    write("journal", whole.substr(0, length));
    const bool has_second = whole.find('\n', second) < length;
    {
      const auto kept = journal();
      EXPECT_TRUE(kept->isDone(0));
      EXPECT_EQ(has_second, kept->isDone(1)) << length;
      kept->noteDone(1, {{"status", "ambiguous"}});
      EXPECT_EQ("ambiguous", (*kept)[1].at("status"));
    }
    EXPECT_EQ("ambiguous", (*journal())[1].at("status"));
  }
}

TEST_F(BatchFiles, JournalsWithADamagedLine)
{
  {
    const auto kept = journal();
    for (const std::size_t pair : {0, 1, 2})
      kept->noteDone(pair, {{"status", "registered"}});
    EXPECT_EQ(0u, kept->numberDamaged());
  }
  std::string damaged = content("journal");
  damaged[damaged.find("{\"done\":2") + 12] = '\0';
  write("journal", damaged);
  const auto kept = journal();
  EXPECT_EQ(1u, kept->numberDamaged());
  EXPECT_TRUE(kept->isDone(0) && !kept->isDone(1) && kept->isDone(2));
  EXPECT_EQ("registered", (*kept)[2].at("status"));
}

TEST_F(BatchFiles, JournalsOfOtherRuns)
{
  journal("a");
  EXPECT_THROW(journal("b"), std::runtime_error);
  EXPECT_NO_THROW(journal("b", true));
  EXPECT_NO_THROW(journal("b"));
  write("journal", "{\"text\":\"of somebody else\"}\n");
  EXPECT_THROW(journal("b"), std::runtime_error);
  const auto used = journal("b", true);
  EXPECT_THROW(journal("b"), std::runtime_error);
}

TEST_F(BatchFiles, JournalsTellOfWhatEndedTheProgram)
{
  std::string killed;
  {
    const auto kept = journal();
    kept->noteBegun(0);
    kept->noteBegun(1);
    kept->noteDone(0, {{"status", "registered"}});
    killed = content("journal");
  }
  EXPECT_EQ(0u, journal()->deaths(1)) << "it ended as it should";
  for (unsigned int times = 1; times < 4; ++times) {
    write("journal", killed);
    const auto kept = journal();
    EXPECT_EQ(times, kept->deaths(1));
    EXPECT_EQ(0u, kept->deaths(0));
    EXPECT_EQ(0u, kept->deaths(2));
    kept->noteBegun(1);
    killed = content("journal");
  }
}

} // namespace
