#pragma once
#include <string>

namespace btr::vrml {

/// The only place where inlined files may lie: the folder of the main file, and below. A file that someone downloaded
/// must not be able to read other files, devices or the network.
class InlineFolder {
 public:
  explicit InlineFolder(const std::string& mainFile);

  struct Answer {
    std::string path;     ///< canonical; empty if refused
    std::string refusal;  ///< why
  };
  /// `from` is the canonical path of the file that holds the Inline. Absolute paths, schemes, "..", symbolic links that
  /// lead out, and everything but a regular file are refused.
  Answer find(const std::string& url, const std::string& from) const;

 private:
  std::string folder_;
};

/// The canonical path of a file, or the path itself if there is no such file.
std::string canonicalPath(const std::string& path);

}  // namespace btr::vrml
