#include "core/openr/builder/merged_config.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <vector>

#include "core/openr/file_text.h"

namespace btr::openr {

std::string mergedConfig(const std::string& first, const std::string& second) {
  std::vector<std::string> order = {""};
  std::map<std::string, std::vector<std::string>> sections;
  for (const std::string* text : {&first, &second}) {
    std::string section;
    std::istringstream in(*text);
    for (std::string line; std::getline(in, line);) {
      while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
      if (line.empty()) continue;
      if (line[0] == '[') {
        section = upper(line);
        if (std::find(order.begin(), order.end(), section) == order.end()) order.push_back(section);
        continue;
      }
      auto& lines = sections[section];
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
  }
  std::string merged;
  for (const std::string& section : order) {
    if (!section.empty()) merged += section + "\n";
    for (const std::string& line : sections[section]) merged += line + "\n";
  }
  return merged;
}

}  // namespace btr::openr
