#include "core/model/vrml/inline_folder.h"

#include <algorithm>
#include <filesystem>

namespace btr::vrml {
namespace fs = std::filesystem;

std::string canonicalPath(const std::string& path) {
  std::error_code error;
  const fs::path result = fs::canonical(path, error);
  return error ? path : result.string();
}

InlineFolder::InlineFolder(const std::string& mainFile)
    : folder_(fs::path(canonicalPath(mainFile)).parent_path().string()) {}

InlineFolder::Answer InlineFolder::find(const std::string& url, const std::string& from) const {
  // What the text itself gives away.
  if (url.empty() || url.size() > 1024 || url.find('\0') != std::string::npos) return {"", "not a file name"};
  if (url.find(':') != std::string::npos) return {"", "only a file name may be given, no address"};
  if (url.front() == '/' || url.find('\\') != std::string::npos) return {"", "only a relative path may be given"};
  const fs::path relative(url);
  if (std::any_of(relative.begin(), relative.end(), [](const fs::path& part) { return part == ".."; }))
    return {"", "\"..\" may not be used"};

  // Where it really leads.
  std::error_code error;
  const fs::path path = fs::canonical(fs::path(from).parent_path() / relative, error);
  if (error) return {"", "there is no such file"};
  const fs::path inside = path.lexically_relative(folder_);
  if (inside.empty() || *inside.begin() == "..") return {"", "it leads out of the folder of the main file"};
  if (!fs::is_regular_file(path, error)) return {"", "it is not a regular file"};
  return {path.string(), ""};
}

}  // namespace btr::vrml
