#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/gap/recordings/table/table_layout.h"
#include "core/gap/recordings/table/text_source.h"
#include "core/spec/csv.h"

namespace btr {

/// Reads a table of measurements as programs write them: UTF-8 or UTF-16, commas, semicolons, tabulators or bars
/// between columns, a preamble above the heading, rows of units below it, comments, separators at the ends of lines,
/// rows that hold nothing, the heading again; or no heading at all. What was passed over stands in notes(). Throws
/// InputError with line and column for what cannot be a table.
class TableReader {
 public:
  /// `timeColumn` ("": no column has the time) and `otherColumns` are the names by which the heading is known. Files
  /// larger than `limit` bytes are refused before they are read.
  TableReader(const std::string& path, const std::string& timeColumn, const std::vector<std::string>& otherColumns,
              std::size_t limit = std::size_t{1} << 30);

  /// Names without blanks around them, of a table without a heading "column 1", "column 2" …; "" for a first column
  /// without a name (some programs number their rows there).
  const std::vector<std::string>& header() const { return header_; }
  long headingLine() const { return headingLine_; }
  std::string atHeading(std::size_t column) const;
  /// The next row, as wide as the header; false at the end.
  bool next(std::vector<std::string>& cells);
  long line() const { return line_; }  ///< of the row last read
  /// "FILE line 3, column 2" for that row; 0 leaves the column out.
  std::string at(std::size_t column = 0) const;

  std::uintmax_t size() const { return size_; }  ///< of the file, bytes
  std::uintmax_t bytesRead() const { return source_.bytesRead(); }
  bool endsWithLine() const { return source_.endsWithLine(); }  ///< once all was read
  /// SHA-256 of the file; once, after the last row.
  std::string finish() { return source_.finish(); }
  /// What was passed over or looks odd, complete after the last row.
  std::vector<std::string> notes() const;

 private:
  void readHeader();
  bool readRow(std::vector<std::string>& cells);
  bool fitsHeader(std::vector<std::string>& cells);
  bool isUnits(const std::vector<std::string>& cells) const;

  std::string path_;
  std::uintmax_t size_ = 0;
  TextSource source_;
  TableLayout layout_;
  CsvReader reader_;
  std::vector<std::string> header_, pending_, notes_;
  bool hasPending_ = false;
  long headingLine_ = 0, line_ = 0, pendingLine_ = 0;
  std::size_t emptyRows_ = 0, headings_ = 0;
  long firstEmpty_ = 0, firstHeading_ = 0;
};

}  // namespace btr
