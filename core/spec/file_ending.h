#pragma once
#include <filesystem>
#include <string>

namespace btr {

/// ".urdf" of "robot.URDF": the ending in small ASCII letters, "" for none.
inline std::string fileEnding(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

}  // namespace btr
