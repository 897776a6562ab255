#include "core/spec/csv.h"

#include "core/spec/error.h"
#include "core/spec/utf8.h"

namespace btr {

CsvReader::CsvReader(std::istream& stream, std::string place, char separator, CsvLimits limits)
    : stream_(stream), place_(std::move(place)), separator_(separator), limits_(limits) {}

std::string CsvReader::at(std::size_t column) const {
  std::string text = place_ + " line " + std::to_string(rowLine_);
  if (column > 0) text += ", column " + std::to_string(column);
  return text;
}

int CsvReader::peek() {
  if (position_ == filled_) {
    buffer_.resize(1 << 16);
    stream_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    filled_ = static_cast<std::size_t>(stream_.gcount());
    position_ = 0;
    if (stream_.bad())
      throw InputError(place_ + " line " + std::to_string(line_) + ": the file cannot be read further");
    total_ += filled_;
    if (total_ > limits_.bytes)
      throw InputError(place_ + ": more than " + std::to_string(limits_.bytes) + " bytes are not allowed");
    if (filled_ == 0) return endOfFile;
  }
  return static_cast<unsigned char>(buffer_[position_]);
}

int CsvReader::take() {
  const int byte = peek();
  if (byte != endOfFile) ++position_;
  return byte;
}

// LF, CRLF or CR, or the end of the file.
bool CsvReader::takeLineEnd() {
  const int byte = peek();
  if (byte == endOfFile) return true;
  if (byte != '\n' && byte != '\r') return false;
  take();
  if (byte == '\r' && peek() == '\n') take();
  ++line_;
  return true;
}

void CsvReader::append(std::string& field, char byte, std::size_t column) const {
  if (byte == '\0') throw InputError(at(column) + ": a NUL byte is not allowed; text in UTF-8");
  if (field.size() >= limits_.fieldBytes)
    throw InputError(at(column) + ": more than " + std::to_string(limits_.fieldBytes) +
                     " bytes in a field are not allowed");
  field += byte;
}

// From behind the opening quote to behind the closing one.
void CsvReader::readQuoted(std::string& field, std::size_t column) {
  while (true) {
    const int byte = take();
    if (byte == endOfFile) throw InputError(at(column) + ": the quote that opens this field is never closed");
    if (byte == '"') {
      if (peek() != '"') break;
      take();
    }
    if (byte == '\n' || (byte == '\r' && peek() != '\n')) ++line_;
    append(field, static_cast<char>(byte), column);
  }
  const int after = peek();
  if (after != endOfFile && after != separator_ && after != '\n' && after != '\r')
    throw InputError(at(column), "text behind the closing quote", "a separator or the end of the line");
}

// A byte order mark may open the file.
void CsvReader::takeByteOrderMark() {
  if (begun_) return;
  begun_ = true;
  if (peek() != 0xEF) return;
  take();
  if (take() != 0xBB || take() != 0xBF) throw InputError(place_ + " line 1, column 1: text in UTF-8 is expected");
}

void CsvReader::skipLine() {
  takeByteOrderMark();
  while (!takeLineEnd()) take();
}

void CsvReader::skipBytes(std::size_t count) {
  takeByteOrderMark();
  for (; count > 0; --count) take();
}

bool CsvReader::takeComment() {
  const int byte = peek();
  if (byte == endOfFile || commentMarks_.find(static_cast<char>(byte)) == std::string::npos) return false;
  skipLine();
  ++comments_;
  return true;
}

bool CsvReader::next(std::vector<std::string>& fields) {
  takeByteOrderMark();
  // Empty lines and comments are passed over.
  while (peek() != endOfFile && (takeLineEnd() || takeComment())) continue;
  if (peek() == endOfFile) {
    fields.clear();
    return false;
  }
  rowLine_ = line_;
  std::size_t count = 0;
  while (true) {
    if (count == limits_.fields)
      throw InputError(at() + ": more than " + std::to_string(limits_.fields) + " columns are not allowed");
    if (fields.size() <= count) fields.emplace_back();
    std::string& field = fields[count++];
    field.clear();
    if (peek() == '"') {
      take();
      readQuoted(field, count);
    } else {
      while (peek() != endOfFile && peek() != separator_ && peek() != '\n' && peek() != '\r') {
        if (peek() == '"')
          throw InputError(at(count), "a quote inside a field", "quotes around the whole field, doubled within");
        append(field, static_cast<char>(take()), count);
      }
    }
    requireUtf8(field, at(count));
    if (peek() != endOfFile && peek() == separator_) {
      take();
      continue;
    }
    takeLineEnd();
    fields.resize(count);
    return true;
  }
}

std::string csvField(const std::string& text) {
  const bool plain = text.find_first_of(",;\"\r\n\t") == std::string::npos &&
                     (text.empty() || (text.front() != ' ' && text.back() != ' '));
  if (plain) return text;
  std::string quoted = "\"";
  for (const char byte : text) {
    if (byte == '"') quoted += '"';
    quoted += byte;
  }
  return quoted + '"';
}

}  // namespace btr
