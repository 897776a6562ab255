#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "core/model/load_model.h"

namespace btr::vrml {

enum class TokenKind { word, text, openBrace, closeBrace, openBracket, closeBracket, end };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view raw;  ///< as in the file; of a text what stands between the quotes
  int line = 0;
};

/// Cuts VRML text into tokens: words (names, numbers, keywords), texts, braces and brackets. Commas and comments are
/// white space. The scanned text must outlive the scanner. Every error is an InputError "PLACE:LINE: …".
class Scanner {
 public:
  Scanner(std::string_view text, std::string place, const ModelBudget& budget);

  const Token& peek() const { return next_; }
  Token take();
  /// Takes the next token, which must be of this kind; `what` names it in the error.
  Token take(TokenKind kind, const char* what);
  /// Takes the next token if it is of this kind.
  bool takeIf(TokenKind kind);
  /// A name: not a number, no quotes.
  std::string takeName(const char* what);

  const std::string& place() const { return place_; }
  [[noreturn]] void fail(int line, const std::string& message) const;

 private:
  Token scan();
  Token scanText();

  std::string_view text_;
  std::string place_;
  const ModelBudget& budget_;
  std::size_t at_ = 0;
  int line_ = 1;
  Token next_;
};

/// The text with \" and \\ resolved.
std::string unescape(std::string_view raw);
/// What an error message shows of a token: at most 40 characters.
std::string shorten(std::string_view raw);
std::string describe(const Token& token);

}  // namespace btr::vrml
