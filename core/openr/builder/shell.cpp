#include "core/openr/builder/shell.h"

#include <stdlib.h>
#include <sys/wait.h>

#include <cstdio>

#include "core/spec/error.h"

namespace btr::openr {

std::string shellWord(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

int runInShell(const std::filesystem::path& folder, const std::string& command, std::string& said) {
  const std::string all = "cd " + shellWord(folder.string()) + " && { " + command + " ; } 2>&1 >/dev/null </dev/null";
  FILE* out = popen(all.c_str(), "r");
  if (out == nullptr) throw InputError("no shell can be started to call the compiler");
  char piece[4096];
  for (std::size_t count; (count = fread(piece, 1, sizeof(piece), out)) > 0;) said.append(piece, count);
  const int status = pclose(out);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace btr::openr
