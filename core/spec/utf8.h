#pragma once
#include <string>
#include <string_view>

namespace btr {

/// The place of the first byte that is not part of a character in UTF-8 (RFC 3629: shortest forms, no surrogates, up to
/// U+10FFFF), npos if there is none.
std::size_t findInvalidUtf8(std::string_view text);

inline bool isUtf8(std::string_view text) { return findInvalidUtf8(text) == std::string_view::npos; }

/// A text of one byte a letter (ISO 8859-1) in UTF-8.
std::string utf8OfLatin1(std::string_view text);

/// Throws InputError "PLACE: …" for a text that is not UTF-8: JSON could not be made of it any more.
void requireUtf8(const std::string& text, const std::string& place);

}  // namespace btr
