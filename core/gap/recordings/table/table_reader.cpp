#include "core/gap/recordings/table/table_reader.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/gap/recordings/table/number_reader.h"
#include "core/gap/recordings/table/table_preview.h"
#include "core/gap/recordings/table/time_stamp.h"
#include "core/spec/error.h"
#include "core/spec/utf8.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

/// Of a regular file that is not too large.
std::uintmax_t sizeOf(const std::string& path, std::size_t limit) {
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status)) throw InputError(path + ": there is no such file");
  if (!fs::is_regular_file(status)) throw InputError(path + ": is not a regular file");
  const std::uintmax_t size = fs::file_size(path, failure);
  if (!failure && size > limit)
    throw InputError(path, std::to_string(size) + " bytes", "at most " + std::to_string(limit) + " bytes");
  return size;
}

TableLayout layoutOfFile(const std::string& path, const std::string& timeColumn,
                         const std::vector<std::string>& otherColumns) {
  TextSource source(path);
  std::string beginning(1 << 16, '\0');
  source.stream().read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(source.stream().gcount()));
  if (const std::size_t first = beginning.find_first_not_of("\xEF\xBB\xBF \t\r\n");
      first != std::string::npos &&
      (beginning[first] == '{' || beginning.compare(first, 2, "[{") == 0 || beginning.compare(first, 2, "[[") == 0))
    throw InputError(path + ": this is JSON; a recording is a table with a row for each sample (CSV)");
  return layoutOf(beginning, timeColumn, otherColumns);
}

/// Control bytes and stray continuation bytes betray a binary or differently encoded file.
bool isText(const std::string& name) {
  const auto isControl = [](unsigned char byte) { return byte < 0x20 || byte == 0x7f; };
  return std::ranges::none_of(name, isControl) && findInvalidUtf8(name) == std::string::npos;
}

bool isBlank(const std::string& cell) { return cell.find_first_not_of(" \t") == std::string::npos; }

bool isNumberAtAll(const std::string& cell) { return NumberReader().read(cell, 1).has_value(); }

std::string counted(std::size_t number, const std::string& one) {
  return std::to_string(number) + " " + one + (number == 1 ? "" : "s");
}

}  // namespace

TableReader::TableReader(const std::string& path, const std::string& timeColumn,
                         const std::vector<std::string>& otherColumns, std::size_t limit)
    : path_(path),
      size_(sizeOf(path, limit)),
      source_(path),
      layout_(layoutOfFile(path, timeColumn, otherColumns)),
      // Text may be longer in UTF-8 than it is in UTF-16.
      reader_(source_.stream(), path, layout_.separator,
              {.bytes = source_.isUtf16() ? 2 * limit : limit, .fieldBytes = 4096, .fields = 10'000}) {
  readHeader();
}

std::string TableReader::at(std::size_t column) const {
  return path_ + " line " + std::to_string(line_) + (column > 0 ? ", column " + std::to_string(column) : "");
}

std::string TableReader::atHeading(std::size_t column) const {
  return path_ + " line " + std::to_string(headingLine_) + ", column " + std::to_string(column);
}

void TableReader::readHeader() {
  for (long line = 1; line < layout_.headingLine; ++line) reader_.skipLine();
  if (layout_.unnamed > 0) {
    reader_.passOver("#%");
    line_ = headingLine_ = layout_.headingLine;
    for (std::size_t number = 1; number <= layout_.unnamed; ++number) header_.push_back(numberedColumn(number));
    return;
  }
  reader_.skipBytes(layout_.commentBytes);
  if (!reader_.next(header_))
    throw InputError(path_ + ": the file is empty; a header line and rows of numbers are expected");
  if (layout_.separator == blanks) joinBlanks(header_);
  reader_.passOver("#%");
  line_ = headingLine_ = reader_.line();
  for (std::size_t i = 0; i < header_.size(); ++i) {
    header_[i] = trimmed(header_[i]);
    if (!isText(header_[i])) throw InputError(at(i + 1), shownCell(header_[i]), "a column name in UTF-8 text");
  }
  while (header_.size() > 1 && header_.back().empty()) header_.pop_back();
  for (std::size_t i = 1; i < header_.size(); ++i)
    if (header_[i].empty()) throw InputError(at(i + 1) + ": the column has no name");
  if (std::ranges::all_of(header_, isNumberAtAll))
    throw InputError(at(), "a row of numbers", "a heading with the columns' names before the numbers");

  // Up to two rows of words, units mostly, stand between heading and numbers.
  std::string units;
  for (int row = 0; row < 3; ++row) {
    hasPending_ = readRow(pending_);
    if (!hasPending_ || row == 2 || !isUnits(pending_)) break;
    std::string cells;
    for (std::size_t i = 0; i < pending_.size() && i < 6; ++i) cells += (i ? ", " : "") + trimmed(pending_[i]);
    notes_.push_back("line " + std::to_string(line_) + " holds words or units (" + cells +
                     (pending_.size() > 6 ? ", ..." : "") + "), passed over; units are those of the mapping");
  }
  pendingLine_ = line_;
}

/// Only text that is neither a number, nor a time, nor a number that is missing.
bool TableReader::isUnits(const std::vector<std::string>& cells) const {
  const auto isMissing = [](const std::string& word) { return saysMissing(word) || word == "inf" || word == "-inf"; };
  bool some = false;
  for (const std::string& cell : cells) {
    if (isBlank(cell)) continue;
    const std::string word = trimmed(cell);
    if (word.find_first_of("0123456789") == 0 || isNumberAtAll(word) || isMissing(word) || readTimeStamp(word))
      return false;
    some = true;
  }
  return some;
}

bool TableReader::next(std::vector<std::string>& cells) {
  if (!std::exchange(hasPending_, false)) return readRow(cells);
  std::swap(cells, pending_);
  line_ = pendingLine_;
  return true;
}

bool TableReader::readRow(std::vector<std::string>& cells) {
  while (reader_.next(cells)) {
    line_ = reader_.line();
    if (layout_.separator == blanks) joinBlanks(cells);
    if (!fitsHeader(cells)) continue;
    if (cells.size() > 1 && std::ranges::all_of(cells, isBlank)) {
      if (emptyRows_++ == 0) firstEmpty_ = line_;
      continue;
    }
    if (std::ranges::equal(cells, header_,
                           [](const std::string& a, const std::string& b) { return trimmed(a) == b; })) {
      if (headings_++ == 0) firstHeading_ = line_;
      continue;
    }
    return true;
  }
  return false;
}

/// Cuts empty cells off that separators at the line's end made. False: the last line, which was cut off.
bool TableReader::fitsHeader(std::vector<std::string>& cells) {
  const std::size_t width = header_.size(), found = cells.size();
  while (cells.size() > width && isBlank(cells.back())) cells.pop_back();
  if (cells.size() == width) return true;
  if (cells.size() < width && reader_.atEnd() && !source_.endsWithLine()) {
    notes_.push_back("the last line, " + std::to_string(line_) + ", was cut off: " + counted(found, "column") + " of " +
                     std::to_string(width) + "; left out");
    return false;
  }
  std::string allowed = "as many as the header has, " + std::to_string(width);
  const auto isWhole = [](const std::string& cell) {
    return cell.find_first_not_of("+-0123456789 ") == std::string::npos;
  };
  if (layout_.separator == ',' && found > width && std::ranges::all_of(cells, isWhole))
    allowed += " (commas as decimals need semicolons between the columns, or quotes around the numbers)";
  throw InputError(at(), std::to_string(found) + (found == 1 ? " column" : " columns"), allowed);
}

std::vector<std::string> TableReader::notes() const {
  std::vector<std::string> notes = notes_;
  if (layout_.unnamed > 0)
    notes.insert(notes.begin(),
                 "the table has no heading: its " + counted(layout_.unnamed, "column") + ", from line " +
                     std::to_string(layout_.headingLine) + " on, " +
                     (layout_.unnamed == 1 ? "is called \"column 1\""
                                           : "are called \"column 1\" to \"" + numberedColumn(layout_.unnamed) + "\""));
  else if (headingLine_ > 1 && layout_.headingLine > 1)
    notes.insert(notes.begin(), "the heading stands in line " + std::to_string(headingLine_) + "; " +
                                    (headingLine_ == 2 ? "the line above it was" : "the lines above it were") +
                                    " passed over");
  if (layout_.commentBytes > 0)
    notes.push_back("the heading, line " + std::to_string(headingLine_) + ", is written as a comment");
  if (reader_.comments() > 0) notes.push_back(counted(reader_.comments(), "line") + " of comment passed over");
  if (emptyRows_ > 0)
    notes.push_back(counted(emptyRows_, "row") + " without anything passed over, the first in line " +
                    std::to_string(firstEmpty_));
  if (headings_ > 0)
    notes.push_back("the heading stands again in line " + std::to_string(firstHeading_) +
                    (headings_ > 1 ? " and " + counted(headings_ - 1, "other line") : "") + "; passed over");
  return notes;
}

}  // namespace btr
