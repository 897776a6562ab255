#pragma once
#include <optional>
#include <string>

namespace btr {

/// The name of a network file system by its number in statfs ("NFS"); empty for others.
std::string networkFileSystem(long magic);

/// The name of the network file system that a database stands on, or would stand on; none for a local one.
std::optional<std::string> networkFileSystemOf(const std::string& path);

/// What to say when a database stands on a network file system: its locks do not hold between machines, and SQLite's
/// write-ahead log needs memory that processes share. None for a local file, also for one that is not there yet in a
/// local folder.
std::optional<std::string> networkWarning(const std::string& path);

}  // namespace btr
