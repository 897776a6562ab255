#include "core/gap/report/equation.h"

#include <cctype>
#include <vector>

#include "core/gap/replay/svg.h"

namespace btr {
namespace {

/// The characters of UTF-8 text, each with the combining marks behind it (dots of derivatives).
std::vector<std::string> charactersOf(const std::string& text) {
  std::vector<std::string> characters;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    const std::string character = text.substr(i, length);
    i += length;
    const bool combines = length == 2 && (lead == 0xCC || lead == 0xCD) && character < "\xCD\xB0";
    if (combines && !characters.empty())
      characters.back() += character;
    else
      characters.push_back(character);
  }
  return characters;
}

bool isLatin(const std::string& c) { return std::isalpha(static_cast<unsigned char>(c[0])) != 0; }
/// Latin, Greek, and Latin letters with a dot.
bool isLetter(const std::string& c) {
  const auto lead = static_cast<unsigned char>(c[0]);
  return isLatin(c) || lead == 0xCE || lead == 0xCF || (lead == 0xE1 && c != "\xE1") || lead == 0xC4 || lead == 0xC5;
}
bool isDigit(const std::string& c) { return std::isdigit(static_cast<unsigned char>(c[0])) != 0; }
bool isSign(const std::string& c) { return c == "+" || c == "−" || c == "-"; }

}  // namespace

std::string equationHtml(const std::string& equation) {
  const std::vector<std::string> all = charactersOf(equation);
  std::string html;
  for (std::size_t i = 0; i < all.size();) {
    if ((all[i] == "_" || all[i] == "^") && i + 1 < all.size()) {
      const std::string tag = all[i] == "_" ? "sub" : "sup";
      std::string inside;
      std::size_t k = i + 1;
      if (isSign(all[k])) inside += all[k++];
      while (k < all.size() && (isLetter(all[k]) || isDigit(all[k]))) inside += all[k++];
      html += "<" + tag + ">" + svg::escaped(inside) + "</" + tag + ">";
      i = k;
      continue;
    }
    std::size_t end = i;
    while (end < all.size() && isLetter(all[end])) ++end;
    if (end == i) {
      html += svg::escaped(all[i++]);
      continue;
    }
    std::string word;
    bool latin = true;
    for (std::size_t k = i; k < end; ++k) {
      word += all[k];
      latin = latin && isLatin(all[k]);
    }
    // A word is upright; one letter, or Greek ones side by side, are quantities.
    const bool isWord = latin && end - i > 1;
    html += isWord ? svg::escaped(word) : "<i>" + svg::escaped(word) + "</i>";
    i = end;
  }
  return html;
}

}  // namespace btr
