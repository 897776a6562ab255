#include "core/openr/builder/build_hint.h"

namespace btr::openr {

std::string buildHint(const std::string& said) {
  const std::string mark = "No rule to make target '";
  const auto at = said.find(mark);
  if (at == std::string::npos) return "mend what the compiler says above (it compiles C++ of 1998) and build again";
  const auto begin = at + mark.size();
  const std::string file = said.substr(begin, said.find('\'', begin) - begin);
  const auto slash = file.rfind('/');
  const bool isConfig = file.substr(slash == std::string::npos ? 0 : slash + 1) == "stub.cfg";
  return file + " is missing, which its Makefile needs" +
         (isConfig ? ": it names the object, its subjects and its observers" : "");
}

}  // namespace btr::openr
