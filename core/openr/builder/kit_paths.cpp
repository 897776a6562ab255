#include "core/openr/builder/kit_paths.h"

#include <regex>

namespace btr::openr {
namespace {

/// A path, perhaps below a folder that a variable names, that ends with the kit's name and perhaps its version.
const std::regex& kitFolder() {
  static const std::regex pattern(R"((\$[({]\w+[)}])?(/[\w.~+-]+)*/OPEN_?R_SDK([-_.]?\d[\w.]*)?(?![\w-]))");
  return pattern;
}

}  // namespace

bool isKitFolder(const std::string& value) {
  const bool slash = !value.empty() && value.back() == '/';
  return std::regex_match(slash ? value.substr(0, value.size() - 1) : value, kitFolder());
}

std::string withKitAt(const std::string& makefile, const std::string& kit) {
  std::string replacement;  // a dollar is two to make, and each of them is two to the replacement
  for (const char c : kit) replacement += c == '$' ? std::string("$$$$") : std::string(1, c);
  return std::regex_replace(makefile, kitFolder(), replacement);
}

}  // namespace btr::openr
