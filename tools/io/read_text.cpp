/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "format_readers.h"
#include "text_header.h"
#include "text_lines.h"
#include "text_rows.h"
#include "text_table.h"

#include <boost/algorithm/string/predicate.hpp>

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
  : lines_(stream, TextLines::Style::RAW)
  {
  }

  TextTable
  read()
  {
    while (lines_.next())
      if (std::string mark = commentMark(lines_.text()); !mark.empty())
        addTitle(std::move(mark));
      else if (!rows_)
        readTitleOrFirstRow();
      else
        readRow();
    blocks_.check();
    if (!rows_)
      throw std::runtime_error("holds no points");
    return std::move(table_);
  }

private:
  void
  addTitle(std::string mark)
  {
    constexpr std::size_t most = 20; // the names stand right above the rows
    if (rows_)
      return;
    if (titles_.size() == most)
      titles_.erase(titles_.begin());
    const std::string text = lines_.text().substr(mark.size());
    titles_.push_back({lines_.number(), std::move(mark), text});
  }

  void
  readTitleOrFirstRow()
  {
    std::optional<Delimiter> delimiter;
    if (!isFirstRow(lines_.text(), titles_, delimiter)) {
      constexpr int most = 100; // more is prose
      if (++lines_of_words_ > most)
        lines_.fail("is no row of numbers, nor is any line before it");
      return addTitle("");
    }
    lines_.cutComment();
    RowFormat format =
        delimiter ? RowFormat(lines_.text(), *delimiter) : RowFormat(lines_.text());
    splitColumns(lines_.text(), format.delimiter(), words_);
    dropLast(headerOf(titles_, format.delimiter(), words_.size()).has_value());
    double number;
    if (words_.size() == 1 && !blocks_.areAnnounced() &&
        format.parse(words_[0], number))
      return blocks_.announce(lines_, number);
    if (words_.size() < 3)
      lines_.fail("has " + std::to_string(words_.size()) +
                  " columns; x, y and z are needed");
    rows_.emplace(format);
    nameColumns();
    takeRow();
  }

  void
  nameColumns()
  {
    const std::size_t columns = words_.size();
    const auto header = headerOf(titles_, rows_->delimiter(), columns);
    table_.names = header ? header->names : std::vector<std::string>();
    table_.has_names = header.has_value();
    if (header)
      table_.header_mark = header->mark;
    else
      tellOfTitles();
    checkNames(table_.names);
    table_.columns = columns;
    table_.kinds.assign(columns, TextTable::Kind::OPEN);
    for (std::size_t i = 0; i < columns; ++i)
      if (table_.isPosition(i))
        table_.kinds[i] = TextTable::Kind::NUMBERS;
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
                             "') names no columns x, y and z; the first three were "
                             "taken for them");
  }

  void
  readRow()
  {
    if (lines_.text().find('#') != std::string::npos)
      lines_.cutComment();
    splitColumns(lines_.text(), rows_->delimiter(), words_);
    dropLast(words_.size() <= table_.columns);
    double number;
    if (words_.size() == 1 && blocks_.areAnnounced() && rows_->parse(words_[0], number))
      return blocks_.announce(lines_, number);
    if (words_.size() != table_.columns)
      lines_.fail("has " + std::to_string(words_.size()) + " columns instead of " +
                  std::to_string(table_.columns) +
                  "; the file is damaged or incomplete");
    takeRow();
  }

  /** Separators may stand at the end of lines, too, where there is no column. */
  void
  dropLast(bool is_column)
  {
    if (!is_column && words_.size() > 1 && words_.back().empty())
      words_.pop_back();
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
      else if (kind == TextTable::Kind::OPEN)
        kind = TextTable::Kind::WORDS;
      else
        lines_.failAt(words_[i], "is not a number");
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
  int lines_of_words_ = 0;
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
