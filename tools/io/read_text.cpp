/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "format_readers.h"
#include "text_header.h"
#include "text_lines.h"
#include "text_rows.h"
#include "text_table.h"
#include "white_space.h"

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace tool {
namespace {

/** Rows of which their number is announced, once or before each of several blocks. */
class Blocks {
public:
  void
  announce(const TextLines& lines, double number)
  {
    check();
    if (!(number >= 0.0) || number != std::floor(number))
      lines.fail("is not a number of points");
    announced_ = number;
    rows_ = 0.0;
    ++blocks_;
  }

  bool
  areAnnounced() const
  {
    return blocks_ > 0;
  }

  void
  addRow()
  {
    rows_ += 1.0;
  }

  void
  check() const
  {
    if (areAnnounced() && announced_ != rows_)
      throw std::runtime_error(
          (blocks_ == 1 ? "" : "its block " + std::to_string(blocks_) + ' ') +
          "holds " + std::to_string(static_cast<long long>(rows_)) +
          " points, but the line above them announces another number; the file is "
          "damaged or incomplete");
  }

private:
  double announced_ = 0.0, rows_ = 0.0;
  int blocks_ = 0;
};

/** Reads the lines of a text into a table. */
class TableReader {
public:
  explicit TableReader(std::istream& stream)
  : lines_(stream, TextLines::Style::COLUMNS)
  {
  }

  TextTable
  read()
  {
    while (lines_.next())
      if (std::string mark = commentMark(lines_.text()); !mark.empty())
        addComment(std::move(mark));
      else if (!rows_)
        readTitleOrFirstRow();
      else
        readRow();
    blocks_.check();
    if (!rows_)
      failWithoutRows();
    tellOfMarkedRows();
    if (header_ && header_->names.size() != table_.columns)
      placeNames();
    return std::move(table_);
  }

private:
  /** Comments above the rows may name the columns, and others may be rows: those of
   * which the name starts with a mark, or that somebody has taken out. */
  void
  addComment(std::string mark)
  {
    if (!rows_)
      addTitle(std::move(mark));
    else if (mark == "#")
      countMarkedRow(lines_.number(), lines_.text());
  }

  void
  countMarkedRow(std::size_t number, std::string_view line)
  {
    RowFormat format = *rows_;
    std::vector<std::string_view> words;
    splitColumns(line, format.delimiter(), words);
    double ignored;
    if (words.size() == table_.columns && words[0] != "#" &&
        std::all_of(words.begin() + 1, words.end(),
                    [&](auto word) { return format.parse(word, ignored); }) &&
        marked_rows_++ == 0)
      first_marked_row_ = number;
  }

  void
  tellOfMarkedRows()
  {
    if (marked_rows_ > 0)
      table_.assumed.push_back(
          std::to_string(marked_rows_) +
          (marked_rows_ == 1 ? " line that starts with # (line "
                             : " lines that start with # (line ") +
          std::to_string(first_marked_row_) +
          (marked_rows_ == 1 ? ") is left out as a comment, though it looks like a row"
                             : " first) are left out as comments, though they look "
                               "like rows"));
  }

  void
  addTitle(std::string mark)
  {
    constexpr std::size_t most = 20; // the names stand right above the rows
    constexpr std::size_t longest = 1 << 16;
    if (lines_.text().size() > longest)
      return;
    if (titles_.size() == most)
      titles_.erase(titles_.begin());
    const auto behind = lines_.text().find(mark) + mark.size();
    titles_.push_back({lines_.number(), std::move(mark), lines_.text().substr(behind)});
  }

  [[noreturn]] void
  failWithoutRows() const
  {
    const auto title = std::find_if(titles_.begin(), titles_.end(), [](const auto& t) {
      return t.text.find_first_of("0123456789") != std::string::npos;
    });
    if (title == titles_.end())
      throw std::runtime_error("holds no points");
    throw std::runtime_error(
        "holds no points: line " + std::to_string(title->line) + " ('" + title->mark +
        title->text.substr(0, 40) + "') is " +
        (title->mark.empty() ? "no row of numbers with white space, commas, semicolons "
                               "or tabs between them"
                             : "a comment, as all lines like it are"));
  }

  void
  readTitleOrFirstRow()
  {
    std::optional<Delimiter> delimiter;
    const std::string_view line = lines_.text(), row = withoutComment(line);
    if (!isFirstRow(line, titles_, delimiter) && !isFirstRow(row, titles_, delimiter)) {
      constexpr int most = 100; // more is prose
      if (++lines_of_words_ > most)
        lines_.fail("is no row of numbers, nor is any line before it");
      return addTitle("");
    }
    RowFormat format = delimiter ? RowFormat(row, *delimiter) : RowFormat(row);
    splitRow(format.delimiter(), [&](std::size_t columns) {
      return namesAll(titles_, format.delimiter(), columns);
    });
    double number;
    if (words_.size() == 1 && !blocks_.areAnnounced() &&
        format.parse(words_[0], number))
      return blocks_.announce(lines_, number);
    if (words_.size() < 3)
      lines_.fail("has " + std::to_string(words_.size()) +
                  " columns; x, y and z are needed");
    rows_.emplace(format);
    nameColumns();
    for (const auto& title : titles_)
      if (title.mark == "#")
        countMarkedRow(title.line, '#' + title.text);
    takeRow();
  }

  void
  nameColumns()
  {
    const std::size_t columns = words_.size();
    const bool starts_with_name = startsWithName();
    header_ = headerOf(titles_, rows_->delimiter(), columns);
    table_.has_names = header_.has_value();
    table_.columns = columns;
    table_.kinds.assign(columns, TextTable::Kind::OPEN);
    if (header_) {
      if (header_->names.size() + 1 == columns && starts_with_name)
        header_->names = namesBehindRow(header_->names);
      if (header_->names.size() > columns)
        failOfHeader();
      table_.names = header_->names;
      table_.header_mark = header_->mark;
      for (std::size_t i = table_.names.size(); i < columns; ++i)
        table_.names.push_back("column_" + std::to_string(i + 1));
    }
    else {
      table_.first_position = starts_with_name ? 1 : 0;
      tellOfTitles();
    }
    checkNames(table_.names);
    for (std::size_t i = 0; i < columns; ++i)
      if (table_.isPosition(i))
        table_.kinds[i] = TextTable::Kind::NUMBERS;
  }

  /** Whether a word comes first, and three numbers behind it. */
  bool
  startsWithName()
  {
    RowFormat format = *rows_;
    double ignored;
    return words_.size() > 3 && !format.parse(words_[0], ignored) &&
           std::all_of(words_.begin() + 1, words_.begin() + 4,
                       [&](auto word) { return format.parse(word, ignored); });
  }

  /** Where a title names fewer columns than there are, the first may be that of the
   * numbers of the rows, which many programs give no name. */
  void
  placeNames()
  {
    const std::size_t names = header_->names.size();
    if (names + 1 == table_.columns && header_->names[0] == "x" &&
        firstColumnCounts(table_)) {
      table_.assumed.push_back("line " + std::to_string(header_->line) + " names " +
                               std::to_string(names) + " of " +
                               std::to_string(table_.columns) +
                               " columns; the first, which counts the rows, was taken "
                               "for the one without a name");
      table_.names = namesBehindRow(header_->names);
      for (std::size_t i = 0; i < table_.columns; ++i)
        if (table_.isPosition(i) && table_.kinds[i] != TextTable::Kind::NUMBERS)
          failOfHeader();
    }
    else if (header_->is_start_of_row)
      table_.assumed.push_back("line " + std::to_string(header_->line) + " names " +
                               std::to_string(names) + " of " +
                               std::to_string(table_.columns) +
                               " columns; they were taken for the first ones");
    else
      failOfHeader();
  }

  [[noreturn]] void
  failOfHeader() const
  {
    throw std::runtime_error("line " + std::to_string(header_->line) + ": names " +
                             std::to_string(header_->names.size()) +
                             " columns, but the rows have " +
                             std::to_string(table_.columns) +
                             "; name all of them, and use one decimal sign");
  }

  /** Titles that name no columns may have been meant to. */
  void
  tellOfTitles()
  {
    const Title* title = unclearTitle(titles_, rows_->delimiter(), words_.size());
    if (!title)
      return;
    if (boost::algorithm::istarts_with(title->text, "ncols") ||
        boost::algorithm::istarts_with(titles_[0].text, "ncols"))
      throw std::runtime_error("is a grid of heights and no list of points; save it as "
                               "columns of x, y and z");
    table_.assumed.push_back("line " + std::to_string(title->line) + " ('" +
                             title->text.substr(0, 40) +
                             "') was not taken for names of the columns; the first "
                             "three were taken for x, y and z");
  }

  /** Split the line into columns. A # behind white space starts a comment, unless a
   * column would be missing then: a colour may be #ff0000. Separators may stand at the
   * end of a line, too, where there is no column.
   * \param[in] is_complete whether so many columns are all
   */
  template <typename Predicate>
  void
  splitRow(Delimiter delimiter, Predicate&& is_complete)
  {
    const auto split = [&](std::string_view line) {
      splitColumns(line, delimiter, words_);
      if (words_.size() > 1 && words_.back().empty() && !is_complete(words_.size()))
        words_.pop_back();
      return is_complete(words_.size());
    };
    const std::string_view line = lines_.text();
    const std::string_view row = withoutComment(line);
    if (row.size() == line.size() || (!split(row) && !split(line)))
      split(row);
  }

  void
  readRow()
  {
    splitRow(rows_->delimiter(),
             [&](std::size_t columns) { return columns == table_.columns; });
    double number;
    if (words_.size() == 1 && blocks_.areAnnounced() && rows_->parse(words_[0], number))
      return blocks_.announce(lines_, number);
    if (words_.size() != table_.columns)
      lines_.fail("has " + std::to_string(words_.size()) + " columns instead of " +
                  std::to_string(table_.columns) +
                  "; the file is damaged or incomplete");
    takeRow();
  }

  void
  takeRow()
  {
    bool has_position = true;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      double number = std::numeric_limits<double>::quiet_NaN();
      auto& kind = table_.kinds[i];
      if (kind == TextTable::Kind::WORDS)
        ;
      else if (rows_->parse(words_[i], number)) {
        if (std::isfinite(number)) {
          if (std::abs(number) > std::numeric_limits<float>::max() &&
              table_.isPosition(i))
            lines_.failAt(words_[i], "is larger than single precision can hold");
          kind = TextTable::Kind::NUMBERS;
        }
        else
          has_position = has_position && !table_.isPosition(i);
      }
      else if (table_.isPosition(i))
        lines_.failAt(words_[i], "is not a number");
      else {
        if (kind == TextTable::Kind::NUMBERS) // so that typing errors are found
          table_.strays[i] = "line " + std::to_string(lines_.number()) + ": '" +
                             std::string(words_[i].substr(0, 40)) + "' is not a number";
        kind = TextTable::Kind::WORDS;
      }
      table_.values.push_back(number);
    }
    blocks_.addRow();
    if (has_position)
      return;
    table_.values.resize(table_.values.size() - words_.size());
    if (table_.rows_without_point++ == 0)
      table_.first_without_point = lines_.number();
  }

  TextLines lines_;
  std::vector<Title> titles_;
  std::optional<TextHeader> header_;
  int lines_of_words_ = 0;
  std::size_t marked_rows_ = 0, first_marked_row_ = 0;
  std::optional<RowFormat> rows_;
  std::vector<std::string_view> words_;
  Blocks blocks_;
  TextTable table_;
};

} // namespace

Geometry
readText(std::istream& stream, FileFormat format)
{
  return toGeometry(TableReader(stream).read(), format);
}

} // namespace tool
