#include "core/openr/builder/robot_longs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "core/openr/builder/compiler_complaints.h"

namespace btr::openr {
namespace {

struct Word {
  std::size_t at, length;
};

/// Words that stand beside `long` in the name of a type.
bool goesWithLong(std::string_view word) {
  constexpr std::array<std::string_view, 18> all{
      "long",     "int",    "unsigned", "signed",  "double", "const",   "volatile", "static", "extern",
      "register", "inline", "typedef",  "mutable", "auto",   "virtual", "friend",   "short",  "__extension__"};
  return std::find(all.begin(), all.end(), word) != all.end();
}

/// Whether the lines behind this one, `# 12 "file" 3 4`, are the program's own; 3 stands for a header of the system.
bool beginsOwnLines(const std::string& marker, const std::string& kit) {
  const auto from = marker.find('"'), to = marker.rfind('"');
  if (from == std::string::npos || to == from) return false;
  const std::string file = marker.substr(from + 1, to - from - 1);
  if (file.empty() || file.front() == '<') return false;
  return marker.find(" 3", to) == std::string::npos && (kit.empty() || file.compare(0, kit.size(), kit) != 0);
}

/// 1 for each character that stands in the program's own lines.
std::vector<char> ownCharacters(const std::string& text, const std::string& kit) {
  std::vector<char> own(text.size(), 0);
  bool is = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const bool isMarker = text.compare(begin, 2, "# ") == 0 && begin + 2 < text.size() &&
                          std::isdigit(static_cast<unsigned char>(text[begin + 2])) != 0;
    if (isMarker)
      is = beginsOwnLines(text.substr(begin, end - begin), kit);
    else if (is)
      std::fill(own.begin() + static_cast<std::ptrdiff_t>(begin), own.begin() + static_cast<std::ptrdiff_t>(end), 1);
    begin = end;
  }
  return own;
}

/// Changes of the words of one type, of which just one is `long`.
void narrow(const std::string& bare, const std::vector<Word>& type, Changes& changes) {
  const Word* found = nullptr;
  int longs = 0;
  bool hasInt = false, hasDouble = false;
  for (const Word& word : type) {
    const std::string_view text = std::string_view(bare).substr(word.at, word.length);
    if (text == "long" && ++longs == 1) found = &word;
    hasInt = hasInt || text == "int";
    hasDouble = hasDouble || text == "double";
  }
  if (longs == 1 && !hasDouble) changes[found->at] = {found->length, hasInt ? "    " : "int "};
}

/// An integer's ending without the L of `long`, with a blank for it: "12UL" is "12U ". The same text for other numbers.
std::string withoutLong(const std::string& number) {
  const bool isHex = number.size() > 2 && number[0] == '0' && (number[1] == 'x' || number[1] == 'X');
  std::size_t digits = isHex ? 2 : 0;
  const auto isDigit = [&](char c) {
    const auto u = static_cast<unsigned char>(c);
    return isHex ? std::isxdigit(u) != 0 : std::isdigit(u) != 0;
  };
  while (digits < number.size() && isDigit(number[digits])) ++digits;
  const std::string ending = number.substr(digits);
  const auto isL = [](char c) { return c == 'l' || c == 'L'; };
  if (ending.find_first_not_of("uUlL") != std::string::npos || std::count_if(ending.begin(), ending.end(), isL) != 1)
    return number;
  std::string kept = number.substr(0, digits);
  for (const char c : ending)
    if (!isL(c)) kept += c;
  return kept + ' ';
}

/// The system's own names of an `unsigned long`.
void narrowSystemNames(const std::string& text, Changes& changes) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 2> lines{
      {{"typedef unsigned long int ulong;", "typedef unsigned      int ulong;"},
       {"typedef __u_long u_long;", "typedef unsigned u_long;"}}};
  for (const auto& [before, after] : lines)
    for (auto at = text.find(before); at != std::string::npos; at = text.find(before, at + 1))
      changes[at] = {before.size(), std::string(after)};
}

}  // namespace

std::string withRobotLongs(const std::string& preprocessed, const std::string& kit) {
  const std::string bare = withoutLiterals(preprocessed);
  const std::vector<char> own = ownCharacters(preprocessed, kit);
  Changes changes;
  std::vector<Word> type;
  bool namesLong = false;  // by a name of the system
  const auto endOfType = [&] {
    narrow(bare, type, changes);
    type.clear();
  };
  for (std::size_t at = 0; at < bare.size();) {
    const auto c = static_cast<unsigned char>(bare[at]);
    if (std::isspace(c) != 0) {
      ++at;
      continue;
    }
    if (own[at] == 0 || !isNameCharacter(bare[at])) {
      endOfType();
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < bare.size() && (isNameCharacter(bare[end]) || (std::isdigit(c) != 0 && bare[end] == '.'))) ++end;
    const std::string word = bare.substr(at, end - at);
    if (std::isdigit(c) != 0) {
      endOfType();
      const bool isFraction = at > 0 && bare[at - 1] == '.';
      if (const std::string now = withoutLong(word); !isFraction && now != word) changes[at] = {word.size(), now};
    } else if (goesWithLong(word)) {
      type.push_back({at, word.size()});
    } else {
      endOfType();
      namesLong = namesLong || word == "ulong" || word == "u_long";
    }
    at = end;
  }
  endOfType();
  if (changes.empty() && !namesLong) return preprocessed;
  narrowSystemNames(preprocessed, changes);
  return changed(preprocessed, changes);
}

}  // namespace btr::openr
