#include "core/openr/builder/source_copy.h"

#include <string>
#include <vector>

#include "core/openr/builder/kit_paths.h"
#include "core/openr/builder/makefiles.h"
#include "core/openr/file_text.h"

namespace btr::openr {
namespace fs = std::filesystem;

fs::path copyOfSources(const fs::path& folder, const fs::path& work, const fs::path& sdk) {
  const fs::path source = fs::canonical(folder);
  const fs::path parent = source.parent_path(), above = parent.parent_path();
  const fs::path outer = work / "above", inner = outer / (parent.filename().empty() ? "parent" : parent.filename());
  fs::create_directories(inner);
  const auto linkAll = [&sdk](const fs::path& from, const fs::path& to, const fs::path& except) {
    std::error_code error;
    int count = 0;
    for (fs::directory_iterator at(from, error), end; !error && at != end && count < 500;
         at.increment(error), ++count) {
      const fs::path target = to / at->path().filename();
      if (at->path() == except || at->path().filename().string()[0] == '.') continue;
      std::error_code ignored;
      if (at->is_directory(ignored))
        fs::create_directory_symlink(at->path(), target, ignored);
      else if (at->is_regular_file(ignored) && isPartOfMakefile(at->path()))
        writeContent(target, withKitAt(content(at->path()), sdk.string()));
      else if (at->is_regular_file(ignored))
        fs::create_symlink(at->path(), target, ignored);
    }
  };
  linkAll(parent, inner, source);
  linkAll(above, outer, parent);
  const fs::path copy = inner / source.filename();
  fs::copy(source, copy, fs::copy_options::recursive | fs::copy_options::copy_symlinks);
  std::vector<fs::path> stale;
  for (const auto& entry : fs::recursive_directory_iterator(copy)) {
    if (entry.is_directory()) {
      fs::permissions(entry.path(), fs::perms::owner_all, fs::perm_options::add);
      continue;
    }
    const std::string end = entry.path().extension().string(), name = entry.path().filename().string();
    const fs::path at = entry.path().parent_path();
    if (isPartOfMakefile(entry.path()) && entry.is_regular_file()) {
      fs::permissions(entry.path(), fs::perms::owner_write, fs::perm_options::add);
      writeContent(entry.path(), withKitAt(content(entry.path()), sdk.string()));
    }
    if (end == ".o" || end == ".bin" || end == ".elf" || name.ends_with(".snap.cc")) stale.push_back(entry.path());
    // Of another maker of stubs.
    if ((name == "def.h" || name == "entry.h" || name.ends_with("Stub.h") || name.ends_with("Stub.cc")) &&
        (fs::exists(at / "stub.cfg") || fs::exists(at.parent_path() / "stub.cfg")))
      stale.push_back(entry.path());
  }
  for (const fs::path& path : stale) fs::remove(path);
  return copy;
}

}  // namespace btr::openr
