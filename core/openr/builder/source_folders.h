#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace btr::openr {

/// What a folder of sources holds, wherever in it.
struct SourceFolders {
  std::vector<std::filesystem::path> libraries;             ///< whose Makefile makes one
  std::vector<std::filesystem::path> withMakefile, byHand;  ///< of objects
  std::vector<std::filesystem::path> sticks;                ///< MS folders; without any, those with OPEN-R/MW in them
  std::vector<std::filesystem::path> lists;                 ///< with an OBJECT.CFG outside of sticks
};
SourceFolders findSources(const std::filesystem::path& root);

bool isSource(const std::filesystem::path& path);
/// Whether a source or header in the folder wants the JPEG library.
bool usesJpeg(const std::filesystem::path& folder);
/// The entry of `folder` that has this name but for large and small letters; the name itself if there is none.
std::filesystem::path entryNamed(const std::filesystem::path& folder, const std::string& name);

}  // namespace btr::openr
