#pragma once

#include <filesystem>
#include <string>

namespace btr {

/// A folder of its own for files on their way, in the system's folder for temporary files; gone with this object. Its
/// name begins with `name`. Throws InputError where no folder can be made.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace btr
