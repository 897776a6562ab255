#include "core/store/network_file.h"

#include <sys/vfs.h>

#include <filesystem>

namespace btr {

std::string networkFileSystem(long magic) {
  // Numbers as in linux/magic.h and the kernel's file systems.
  switch (static_cast<unsigned long>(magic) & 0xffffffffUL) {
    case 0x6969:
      return "NFS";
    case 0x517B:
      return "SMB";
    case 0xFF534D42:
      return "CIFS";
    case 0xFE534D42:
      return "SMB";
    case 0x5346414F:
      return "AFS";
    case 0x00C36400:
      return "Ceph";
    case 0x01021997:
      return "9P";
    default:
      return "";
  }
}

std::optional<std::string> networkFileSystemOf(const std::string& path) {
  std::error_code error;
  std::filesystem::path place = std::filesystem::absolute(path, error);
  if (!std::filesystem::exists(place, error)) place = place.parent_path();
  struct statfs about {};
  if (statfs(place.c_str(), &about) != 0) return std::nullopt;
  const std::string name = networkFileSystem(static_cast<long>(about.f_type));
  return name.empty() ? std::nullopt : std::optional(name);
}

std::optional<std::string> networkWarning(const std::string& path) {
  const auto name = networkFileSystemOf(path);
  if (!name) return std::nullopt;
  return path + ": is on a network file system (" + *name +
         "): use it from one machine at a time, or copy it to a local disk (btr backup)";
}

}  // namespace btr
