#include "core/openr/source_cure.h"

#include <cctype>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace btr::openr {
namespace {

using Place = std::pair<std::string, int>;  ///< file and line

bool isNameCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::map<Place, std::set<std::string>> placesOf(const std::string& errors) {
  std::map<Place, std::set<std::string>> places;
  std::istringstream in(errors);
  const std::string mark = ": error: redefinition of '";
  for (std::string line; std::getline(in, line);) {
    const auto at = line.find(mark);
    if (at == std::string::npos) continue;
    const auto close = line.find('\'', at + mark.size());
    const auto columnAt = line.rfind(':', at - 1);
    const auto lineAt = columnAt == std::string::npos ? columnAt : line.rfind(':', columnAt - 1);
    if (close == std::string::npos || lineAt == std::string::npos) continue;
    auto begin = close;
    while (begin > 0 && isNameCharacter(line[begin - 1])) --begin;
    const std::string number = line.substr(lineAt + 1, columnAt - lineAt - 1);
    if (number.empty() || number.size() > 8 || number.find_first_not_of("0123456789") != std::string::npos) continue;
    places[{line.substr(0, lineAt), std::stoi(number)}].insert(line.substr(begin, close - begin));
  }
  return places;
}

/// The last place where `name` stands as a word.
std::size_t lastWord(const std::string& line, const std::string& name) {
  for (auto at = line.rfind(name); at != std::string::npos;
       at = at == 0 ? std::string::npos : line.rfind(name, at - 1)) {
    const bool begins = at == 0 || !isNameCharacter(line[at - 1]);
    const bool ends = at + name.size() == line.size() || !isNameCharacter(line[at + name.size()]);
    if (begins && ends) return at;
  }
  return std::string::npos;
}

}  // namespace

std::string withoutRepeatedNames(const std::string& preprocessed, const std::string& errors) {
  const auto places = placesOf(errors);
  std::istringstream in(preprocessed);
  std::ostringstream out;
  Place at{"", 0};
  for (std::string line; std::getline(in, line); ++at.second) {
    std::istringstream words(line);
    std::string hash, file;
    int number = 0;
    if (line.size() > 2 && line[0] == '#' && words >> hash >> number >> file && file.size() > 1) {
      at = {file.substr(1, file.rfind('"') - 1), number - 1};
    } else if (const auto found = places.find(at); found != places.end()) {
      for (const std::string& name : found->second) {
        const auto word = name.empty() ? std::string::npos : lastWord(line, name);
        if (word != std::string::npos) line.erase(word, name.size());
      }
    }
    out << line << '\n';
  }
  return out.str();
}

}  // namespace btr::openr
