// Reads the value of a field by its type. Numbers are read without the locale and must be finite.
#include <charconv>
#include <cmath>
#include <limits>

#include "core/model/vrml/vrml_parser.h"

namespace btr::vrml {

void Parser::charge(std::size_t values, int line) {
  spent_.values += values;
  if (spent_.values > budget_.values)
    fail(line, "more than " + std::to_string(budget_.values) + " values are not allowed");
}

double Parser::readNumber(bool notANumberAllowed) {
  const Token token = scanner_->take(TokenKind::word, "a number");
  charge(1, token.line);
  std::string_view text = token.raw;
  if (text.front() == '+') text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = end == text.data() + text.size();
  if (error == std::errc::result_out_of_range && whole)
    fail(token.line, describe(token) + " is not allowed; the number is out of the range of a double");
  if (error != std::errc() || !whole) fail(token.line, describe(token) + " is not allowed; a number is expected here");
  if (!std::isfinite(number)) {
    if (!notANumberAllowed) fail(token.line, describe(token) + " is not allowed; a finite number is expected here");
    return std::numeric_limits<double>::quiet_NaN();
  }
  return number;
}

std::int32_t Parser::readInteger() {
  const Token token = scanner_->take(TokenKind::word, "a whole number");
  charge(1, token.line);
  std::string_view text = token.raw;
  const bool plus = text.front() == '+';
  if (plus) text.remove_prefix(1);
  const bool hexadecimal = text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
  if (hexadecimal) text.remove_prefix(2);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, hexadecimal ? 16 : 10);
  const bool fits = number >= std::numeric_limits<std::int32_t>::min() &&
                    number <= (hexadecimal ? 0xFFFFFFFFll : std::numeric_limits<std::int32_t>::max());
  if (error != std::errc() || end != text.data() + text.size() || !fits)
    fail(token.line, describe(token) + " is not allowed; a whole number of 32 bits is expected here");
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(number));
}

/// A picture: width, height, bytes a pixel, pixels. Textures are not drawn, so the pixels are counted and dropped.
void Parser::readImage() {
  const int line = scanner_->peek().line;
  const std::int64_t width = readInteger(), height = readInteger(), components = readInteger();
  if (width < 0 || height < 0 || components < 0 || components > 4)
    fail(line, "a picture has a width and a height of at least 0 and 0 to 4 components");
  const std::int64_t pixels = width * height;
  if (pixels > static_cast<std::int64_t>(budget_.values))
    fail(line, "a picture of more than " + std::to_string(budget_.values) + " pixels is not allowed");
  for (std::int64_t i = 0; i < pixels; ++i) readInteger();
}

void Parser::readNodeValue(Value& value) {
  charge(1, scanner_->peek().line);
  value.nodes.push_back(readNodeStatement());
}

void Parser::readElement(Value& value, FieldType type, bool notANumberAllowed) {
  const auto numbers = [&](auto& into) {
    using Number = typename std::decay_t<decltype(into)>::value_type;
    for (int i = arity(type); i > 0; --i) into.push_back(static_cast<Number>(readNumber(notANumberAllowed)));
  };
  switch (type) {
    case FieldType::SFBool: {
      const Token token = scanner_->take(TokenKind::word, "TRUE or FALSE");
      if (token.raw != "TRUE" && token.raw != "FALSE")
        fail(token.line, describe(token) + " is not allowed; TRUE or FALSE is expected here");
      value.integers.push_back(token.raw == "TRUE");
      break;
    }
    case FieldType::SFInt32:
    case FieldType::MFInt32:
      value.integers.push_back(readInteger());
      break;
    case FieldType::SFString:
    case FieldType::MFString: {
      const Token token = scanner_->take(TokenKind::text, "a text in quotes");
      charge(1, token.line);
      value.texts.push_back(unescape(token.raw));
      break;
    }
    case FieldType::SFNode:
    case FieldType::MFNode:
      readNodeValue(value);
      break;
    case FieldType::SFImage:
      readImage();
      break;
    case FieldType::MFColor:
    case FieldType::MFVec2f:
    case FieldType::MFVec3f:
      numbers(value.packed);
      break;
    default:
      numbers(value.numbers);
  }
}

ValuePtr Parser::readValue(FieldType type, const NodeType& of, std::string_view field) {
  auto value = std::make_shared<Value>();
  value->type = type;
  value->line = scanner_->peek().line;
  // Programs that wrote "nan" for the normal of an empty face are forgiven: the normals are computed instead.
  const bool forgiving = of.name == "Normal" && field == "vector";
  if (isMany(type) && scanner_->takeIf(TokenKind::openBracket)) {
    while (!scanner_->takeIf(TokenKind::closeBracket)) readElement(*value, type, forgiving);
  } else {
    readElement(*value, type, forgiving);
  }
  value->packed.shrink_to_fit();
  value->integers.shrink_to_fit();
  if (type == FieldType::MFNode || type == FieldType::SFNode) return value;

  // A float holds less than a double.
  for (const float number : value->packed)
    if (std::isinf(number)) fail(value->line, "a number in " + std::string(field) + " is out of the range of a float");
  return value;
}

}  // namespace btr::vrml
