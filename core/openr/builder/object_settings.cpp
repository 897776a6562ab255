#include "core/openr/builder/object_settings.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include "core/openr/builder/comments.h"
#include "core/spec/error.h"

namespace btr::openr {
namespace {

bool isWhole(const std::string& word) {
  return word.size() < 10 &&
         std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

bool isObjectLine(const std::vector<std::string>& words) {
  constexpr std::size_t numbersAt = 2, numbersEnd = 5;
  if (words.size() < numbersEnd || words[0] != "object") return false;
  return std::all_of(words.begin() + numbersAt, words.begin() + numbersEnd, isWhole);
}

}  // namespace

std::string objectLineOf(const std::string& ocf, const std::string& file) {
  std::string found;
  std::istringstream in(withoutComments(ocf));
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    // Quotes are around the name, backslashes and returns at the end.
    line.erase(std::remove_if(line.begin(), line.end(), [](char c) { return c == '"' || c == '\\' || c == '\r'; }),
               line.end());
    std::istringstream rest(line);
    std::vector<std::string> words;
    for (std::string word; rest >> word;) words.push_back(word);
    if (words.empty()) continue;
    const std::string place = file + ":" + std::to_string(number);
    if (!isObjectLine(words))
      throw InputError(place, "\"" + line + "\"", "object NAME STACK HEAP PRIORITY cache tlb user, or a comment, is");
    if (!found.empty()) throw InputError(place, "a second object", "one is");
    found = line;
  }
  return found;
}

}  // namespace btr::openr
