#include "core/openr/builder/source_folders.h"

#include <algorithm>
#include <set>

#include "core/openr/builder/makefiles.h"
#include "core/openr/file_text.h"

namespace btr::openr {
namespace fs = std::filesystem;

bool isSource(const fs::path& path) {
  const std::string end = path.extension().string();
  return end == ".cc" || end == ".cpp" || end == ".cxx" || end == ".C" || end == ".c";
}

bool usesJpeg(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if ((isSource(entry.path()) || entry.path().extension() == ".h") && hasAny(content(entry.path()), {"jpeglib.h"}))
      return true;
  return false;
}

fs::path entryNamed(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (!fs::exists(folder / name, error))
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
      if (upper(at->path().filename().string()) == upper(name)) return at->path();
  return folder / name;
}

SourceFolders findSources(const fs::path& root) {
  SourceFolders found;
  std::set<fs::path> sources;         // folders that look like an object's
  std::vector<fs::path> otherSticks;  // with names like MS_ERS7
  std::error_code error;
  for (fs::recursive_directory_iterator at(root, error), end; !error && at != end; at.increment(error)) {
    const fs::path path = at->path();
    const std::string name = path.filename().string();
    if (at->is_directory(error)) {
      if (name[0] == '.') at.disable_recursion_pending();
      const bool isStick = name == "MS";
      if (isStick || fs::exists(entryNamed(entryNamed(path, "OPEN-R"), "MW"), error)) {
        at.disable_recursion_pending();
        // RP/… are set-ups of Sony's remote processing on a PC.
        bool remote = false;
        for (const fs::path& part : path.lexically_relative(root)) remote = remote || part == "RP";
        if (!remote && fs::exists(entryNamed(path, "OPEN-R"))) (isStick ? found.sticks : otherSticks).push_back(path);
      }
      continue;
    }
    if (isMakefile(path) && makesModule(path))
      found.withMakefile.push_back(path.parent_path());
    else if (isMakefile(path) && makesLibrary(path))
      found.libraries.push_back(path.parent_path());
    if (upper(name) == "OBJECT.CFG") found.lists.push_back(path.parent_path());
    if (name == "stub.cfg" || path.extension() == ".ocf" || name.ends_with("Stub.cc"))
      sources.insert(path.parent_path());
  }
  if (found.sticks.empty()) found.sticks = std::move(otherSticks);
  std::sort(found.libraries.begin(), found.libraries.end());
  std::sort(found.withMakefile.begin(), found.withMakefile.end());
  std::sort(found.sticks.begin(), found.sticks.end());
  for (const fs::path& folder : sources) {
    const bool made = std::any_of(found.withMakefile.begin(), found.withMakefile.end(), [&](const fs::path& other) {
      const auto within = [](const fs::path& inner, const fs::path& outer) {
        return inner.lexically_relative(outer).string().rfind("..", 0) != 0;
      };
      return within(other, folder) || within(folder, other);
    });
    if (!made) found.byHand.push_back(folder);
  }
  return found;
}

}  // namespace btr::openr
