#pragma once
#include <cstddef>
#include <istream>
#include <string>
#include <utility>
#include <vector>

namespace btr {

/// How much of a table is read before it is refused.
struct CsvLimits {
  std::size_t bytes = std::size_t{1} << 30;
  std::size_t fieldBytes = std::size_t{1} << 20;
  std::size_t fields = 10'000;  ///< of one row
};

/// Reads a table of comma-separated values (RFC 4180) row by row, in one pass and in constant memory. A byte order
/// mark, empty lines and either line ending (LF, CRLF, also a lone CR) are accepted; quoted fields may hold separators,
/// line breaks and doubled quotes. Spaces belong to the field. Throws InputError with line and column for a quote that
/// is not closed or stands in the middle of a field, for a NUL byte (a binary file), for text that is not UTF-8, for
/// bytes that cannot be read, and beyond the limits. The stream is borrowed.
class CsvReader {
 public:
  /// `place` (usually the file's name) begins each message.
  explicit CsvReader(std::istream& stream, std::string place, char separator = ',', CsvLimits limits = {});

  /// Rows that begin with one of these bytes, not quoted, are comments from now on: passed over, whatever they hold.
  void passOver(std::string firstBytes) { commentMarks_ = std::move(firstBytes); }
  std::size_t comments() const { return comments_; }  ///< passed over so far
  /// Passes over the rest of this line, whatever it holds.
  void skipLine();
  /// Passes over so many bytes.
  void skipBytes(std::size_t count);

  /// The next row that is not empty; false at the end. `fields` keeps its memory from row to row.
  bool next(std::vector<std::string>& fields);
  bool atEnd() { return peek() == endOfFile; }  ///< nothing stands behind the row last read
  /// Line on which the row last read begins, from 1; 0 before the first.
  long line() const { return rowLine_; }
  /// "PLACE line 3, column 2" for the row last read; columns count from 1, 0 leaves the column out.
  std::string at(std::size_t column = 0) const;

 private:
  static constexpr int endOfFile = -1;
  int peek();
  int take();
  bool takeLineEnd();
  void takeByteOrderMark();
  bool takeComment();
  void readQuoted(std::string& field, std::size_t column);
  void append(std::string& field, char byte, std::size_t column) const;

  std::istream& stream_;
  std::string place_;
  char separator_;
  CsvLimits limits_;
  std::vector<char> buffer_;
  std::size_t position_ = 0, filled_ = 0, total_ = 0;
  long line_ = 1, rowLine_ = 0;
  bool begun_ = false;
  std::string commentMarks_;
  std::size_t comments_ = 0;
};

/// The text as one field: quoted when it holds a separator, quote, line break, or a space at either end.
std::string csvField(const std::string& text);

}  // namespace btr
