#include "core/model/vrml/vrml_scanner.h"

#include "core/spec/error.h"

namespace btr::vrml {
namespace {

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ','; }

bool endsWord(char c) { return isSpace(c) || c == '{' || c == '}' || c == '[' || c == ']' || c == '"' || c == '#'; }

/// Bytes that no text file has. Bytes above 127 are parts of UTF-8 letters.
bool isBinary(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 32 && !isSpace(c)) || byte == 127;
}

}  // namespace

std::string unescape(std::string_view raw) {
  std::string result;
  result.reserve(raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] == '\\' && i + 1 < raw.size()) ++i;
    result += raw[i];
  }
  return result;
}

std::string shorten(std::string_view raw) {
  std::string result;
  for (const char c : raw.substr(0, 40)) result += isBinary(c) || c == '\n' || c == '\r' ? '?' : c;
  return raw.size() > 40 ? result + "..." : result;
}

std::string describe(const Token& token) {
  switch (token.kind) {
    case TokenKind::end:
      return "the end of the file";
    case TokenKind::text:
      return '"' + shorten(token.raw) + '"';
    default:
      return shorten(token.raw);
  }
}

Scanner::Scanner(std::string_view text, std::string place, const ModelBudget& budget)
    : text_(text), place_(std::move(place)), budget_(budget) {
  next_ = scan();
}

void Scanner::fail(int line, const std::string& message) const { throw InputError(place_, line, message); }

Token Scanner::take() {
  const Token token = next_;
  next_ = scan();
  return token;
}

Token Scanner::take(TokenKind kind, const char* what) {
  if (next_.kind != kind) fail(next_.line, describe(next_) + " is not allowed; " + what + " is expected here");
  return take();
}

bool Scanner::takeIf(TokenKind kind) {
  if (next_.kind != kind) return false;
  take();
  return true;
}

std::string Scanner::takeName(const char* what) {
  const Token token = take(TokenKind::word, what);
  const char first = token.raw.front();
  const bool number = (first >= '0' && first <= '9') || first == '+' || first == '-' || first == '.';
  if (number || token.raw.find_first_of("'\\") != std::string_view::npos)
    fail(token.line, describe(token) + " is not allowed; " + what + " is expected here");
  return std::string(token.raw);
}

Token Scanner::scan() {
  // White space, commas and comments.
  while (at_ < text_.size() && (isSpace(text_[at_]) || text_[at_] == '#')) {
    if (text_[at_] == '#') {
      while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
      continue;
    }
    // CR LF is one end of line, a lone CR too.
    if (text_[at_] == '\n' || (text_[at_] == '\r' && (at_ + 1 >= text_.size() || text_[at_ + 1] != '\n'))) ++line_;
    ++at_;
  }
  if (at_ >= text_.size()) return {TokenKind::end, {}, line_};

  const char c = text_[at_];
  const std::string_view one = text_.substr(at_, 1);
  switch (c) {
    case '{':
      return ++at_, Token{TokenKind::openBrace, one, line_};
    case '}':
      return ++at_, Token{TokenKind::closeBrace, one, line_};
    case '[':
      return ++at_, Token{TokenKind::openBracket, one, line_};
    case ']':
      return ++at_, Token{TokenKind::closeBracket, one, line_};
    case '"':
      return scanText();
    default:
      break;
  }

  const std::size_t start = at_;
  while (at_ < text_.size() && !endsWord(text_[at_])) {
    if (isBinary(text_[at_])) fail(line_, "a control character is not allowed; VRML97 is plain text");
    ++at_;
    if (at_ - start > budget_.identifier)
      fail(line_, "a word longer than " + std::to_string(budget_.identifier) + " characters is not allowed");
  }
  return {TokenKind::word, text_.substr(start, at_ - start), line_};
}

Token Scanner::scanText() {
  const int startLine = line_;
  const std::size_t start = ++at_;
  for (; at_ < text_.size(); ++at_) {
    if (at_ - start > budget_.text)
      fail(startLine, "a text longer than " + std::to_string(budget_.text) + " characters is not allowed");
    if (text_[at_] == '\\' && at_ + 1 < text_.size()) {
      ++at_;
    } else if (text_[at_] == '"') {
      const Token token{TokenKind::text, text_.substr(start, at_ - start), startLine};
      ++at_;
      return token;
    }
    if (text_[at_] == '\n') ++line_;
  }
  fail(startLine, "the text that begins here has no closing quote");
}

}  // namespace btr::vrml
