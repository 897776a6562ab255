#pragma once
#include <string>

namespace btr {

/// What a file is, judged by its content (the name decides only between a mapping and other JSON).
enum class FileKind {
  missing,
  folder,
  report,  ///< a folder with a gap report
  database,
  experiment,
  scene,
  game,
  simulator,
  grid,
  mapping,
  otherFormat,  ///< another file of ours; see kindInWords()
  json,
  robot,
  recording,
  text,
  binary
};

/// Reads the first 64 KiB. A file that cannot be read counts as missing.
FileKind kindOfFile(const std::string& path);

/// What the file at `path` is, for a message: "a robot model (URDF)", "a text file", "a uchilsim-gait-1 file".
std::string kindInWords(const std::string& path);

/// Says in one InputError what the file is and what was expected. Does nothing where it is of that kind, or missing,
/// or JSON that is not known (reading it names the place).
void requireKind(const std::string& path, FileKind expected);

}  // namespace btr
