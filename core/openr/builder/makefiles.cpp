#include "core/openr/builder/makefiles.h"

#include <sstream>

#include "core/openr/file_text.h"

namespace btr::openr {
namespace {

namespace fs = std::filesystem;

/// `text` with $(NAME) and ${NAME} replaced by what is known of them, else by nothing.
std::string expanded(std::string text, const std::map<std::string, std::string>& values) {
  constexpr int mostReplaced = 50;  // variables may name each other in a circle
  for (int i = 0; i < mostReplaced; ++i) {
    const auto at = text.find('$');
    if (at == std::string::npos || at + 1 == text.size()) break;
    const char open = text[at + 1];
    const auto end = open == '(' ? text.find(')', at) : open == '{' ? text.find('}', at) : std::string::npos;
    if (end == std::string::npos) break;
    const auto found = values.find(text.substr(at + 2, end - at - 2));
    text.replace(at, end - at + 1, found == values.end() ? "" : found->second);
  }
  return text;
}

std::string readTo(const fs::path& folder, const fs::path& makefile, std::map<std::string, std::string>& values,
                   int depth) {
  constexpr int deepest = 5;
  const std::string own = content(makefile);
  std::string all = own;
  std::istringstream in(own);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word, second, third;
    words >> word >> second >> third;
    if (second == "=" || second == ":=" || second == "?=")
      values.emplace(word, third);
    else if (const auto equals = word.find('='); equals != std::string::npos)
      values.emplace(word.substr(0, word.find_first_of(":?=")), word.substr(equals + 1));
    if ((word != "include" && word != "-include" && word != "sinclude") || depth == deepest) continue;
    const fs::path file = folder / expanded(second, values);
    std::error_code error;
    if (fs::is_regular_file(file, error)) all += "\n" + readTo(folder, file, values, depth + 1);
  }
  return all;
}

std::string withIncludes(const fs::path& makefile) {
  std::map<std::string, std::string> values;
  return readTo(makefile.parent_path(), makefile, values, 0);
}

}  // namespace

bool isMakefile(const fs::path& path) {
  const std::string name = path.filename().string();
  return name == "Makefile" || name == "makefile" || name == "GNUmakefile";
}

bool isPartOfMakefile(const fs::path& path) {
  const std::string name = upper(path.filename().string()), end = upper(path.extension().string());
  return name.find("MAKEFILE") != std::string::npos || end == ".MK" || end == ".INC" || end == ".CONFIG" ||
         end == ".DEFS";
}

std::string withIncludes(const fs::path& folder, const fs::path& makefile, std::map<std::string, std::string>& values) {
  return readTo(folder, makefile, values, 0);
}

bool looksLikeObject(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "stub.cfg", error)) return true;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ".ocf") return true;
  return false;
}

bool makesModule(const fs::path& makefile) {
  const std::string own = content(makefile);
  if (hasAny(own, {"/mkbin"})) return true;
  const std::string all = withIncludes(makefile);
  return hasAny(all, {"/mkbin"}) && hasAny(all, {"$(MKBIN)", "${MKBIN}"}) &&
         (hasAny(own, {".bin", ".BIN"}) || looksLikeObject(makefile.parent_path()));
}

bool makesLibrary(const fs::path& makefile) {
  return hasAny(content(makefile), {".a"}) && hasAny(withIncludes(makefile), {"mipsel-linux-ar", "$(AR)", "${AR}"});
}

}  // namespace btr::openr
