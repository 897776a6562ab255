#include "core/openr/builder/compiler_complaints.h"

#include <cctype>
#include <sstream>

namespace btr::openr {

bool isNameCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::vector<Complaint> complaintsOf(const std::string& errors) {
  std::vector<Complaint> complaints;
  std::istringstream in(errors);
  std::string function;
  const std::string mark = ": error: ", within = ": In ";
  for (std::string line; std::getline(in, line);) {
    if (const auto at = line.find(within); at != std::string::npos && line.find(mark) == std::string::npos)
      function = line.substr(at);
    const auto at = line.find(mark);
    if (at == std::string::npos) continue;
    const auto columnAt = line.rfind(':', at - 1);
    const auto lineAt = columnAt == std::string::npos ? columnAt : line.rfind(':', columnAt - 1);
    if (lineAt == std::string::npos) continue;
    std::istringstream numbers(line.substr(lineAt + 1, columnAt - lineAt - 1) + " " +
                               line.substr(columnAt + 1, at - columnAt - 1));
    Complaint complaint{line.substr(0, lineAt), function, line.substr(at + mark.size()), 0, 0};
    if (numbers >> complaint.line >> complaint.column && complaint.column > 0) complaints.push_back(complaint);
  }
  return complaints;
}

std::map<Place, std::size_t> lineBegins(const std::string& preprocessed) {
  std::map<Place, std::size_t> begins;
  Place at{"", 1};
  for (std::size_t begin = 0; begin < preprocessed.size();) {
    auto end = preprocessed.find('\n', begin);
    if (end == std::string::npos) end = preprocessed.size();
    std::istringstream words(preprocessed.substr(begin, end - begin));
    std::string hash, file;
    int number = 0;
    if (preprocessed[begin] == '#' && words >> hash >> number >> file && hash == "#" && file.size() > 1) {
      at = {file.substr(1, file.rfind('"') - 1), number};
    } else {
      begins[at] = begin;
      ++at.second;
    }
    begin = end + 1;
  }
  return begins;
}

std::string withoutLiterals(std::string text) {
  char quote = 0;
  bool lineBegin = true, skipped = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      lineBegin = true;
      skipped = false;
      quote = 0;
      continue;
    }
    if (lineBegin && c == '#') skipped = true;
    lineBegin = lineBegin && std::isspace(static_cast<unsigned char>(c)) != 0;
    if (skipped) {
      text[i] = ' ';
    } else if (quote != 0) {
      text[i] = ' ';
      if (c == '\\' && i + 1 < text.size() && text[i + 1] != '\n')
        text[++i] = ' ';
      else if (c == quote)
        quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
      text[i] = ' ';
    }
  }
  return text;
}

std::string changed(std::string text, const Changes& changes) {
  for (auto change = changes.rbegin(); change != changes.rend(); ++change)
    text.replace(change->first, change->second.length, change->second.text);
  return text;
}

}  // namespace btr::openr
