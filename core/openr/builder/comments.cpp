#include "core/openr/builder/comments.h"

#include <string_view>

namespace btr::openr {

std::string withoutComments(const std::string& text) {
  std::string kept;
  enum class Within { nothing, line, block } within = Within::nothing;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view two = std::string_view(text).substr(i, 2);
    if (text[i] == '\n') {
      kept += '\n';
      if (within == Within::line) within = Within::nothing;
    } else if (within == Within::block) {
      if (two != "*/") continue;
      within = Within::nothing;
      ++i;
    } else if (within == Within::nothing) {
      if (text[i] == '#' || two == "//") {
        within = Within::line;
      } else if (two == "/*") {
        within = Within::block;
        ++i;
      } else {
        kept += text[i];
      }
    }
  }
  return kept;
}

}  // namespace btr::openr
