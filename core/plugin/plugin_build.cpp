#include "core/plugin/plugin_build.h"

#include <cstring>

namespace btr {

std::string differenceOf(const PluginBuild& module, const PluginBuild& program) {
  const auto differ = [](const char* a, const char* b) { return std::strcmp(a, b) != 0; };
  const auto sentence = [](const char* before, const std::string& theirs, const std::string& ours) {
    return before + theirs + ", this program " + (ours.empty() ? ours : "with ") + ours;
  };
  if (differ(module.compiler, program.compiler))
    return std::string("was made by compiler ") + module.compiler + ", this program by " + program.compiler;
  if (differ(module.library, program.library))
    return sentence("was made with the C++ library ", module.library, program.library);
  if (differ(module.eigen, program.eigen)) return sentence("was made with ", module.eigen, program.eigen);
  if (differ(module.arithmetic, program.arithmetic))
    return std::string("computes with ") + module.arithmetic + " arithmetic, this program with " + program.arithmetic +
           ": the same trial would not give the same bits";
  if (differ(module.checks, program.checks)) return sentence("was made with ", module.checks, program.checks);
  if (module.layout != program.layout)
    return "was made with other headers than this program: build it again against this installation";
  return "";
}

}  // namespace btr
