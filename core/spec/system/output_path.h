#pragma once
#include <string>
#include <vector>

// Where results go: asked before the work, so that nothing is lost behind it and nothing is written over what it reads.
namespace btr {

/// The files, and every file that they name if they are JSON (a scene its robots, a comparison its experiments), as far
/// as they exist. What cannot be read is left to its reader.
std::vector<std::string> withNamedFiles(const std::vector<std::string>& files);

/// True if both names lead to the same file, through links or not, or would if it were there.
bool isSameFile(const std::string& one, const std::string& other);

/// Throws InputError unless a file may be written at `path`: its folder is there and can be written, it is no folder
/// itself, no database (a file that begins as SQLite's do), and none of `inputs`. A device or pipe only has to be none
/// of them.
void checkOutputFile(const std::string& path, const std::vector<std::string>& inputs);

/// Makes the folder where it is missing. Throws InputError if that cannot be, if it cannot be written, or if one of
/// `inputs` is one of the files `names` in it.
void checkOutputFolder(const std::string& path, const std::vector<std::string>& names,
                       const std::vector<std::string>& inputs);

/// Throws InputError if `path` is that of an experiment database or of what SQLite and the locks of its runs keep
/// beside it.
void checkNotBesideDatabase(const std::string& path, const std::string& database);

}  // namespace btr
