#pragma once
#include <filesystem>

namespace btr::openr {

/// A copy of the folder, below `work`, in which nothing is left of former builds, and Makefiles find the kit at `sdk`;
/// what stands beside it, one and two folders up, can be reached as before.
std::filesystem::path copyOfSources(const std::filesystem::path& folder, const std::filesystem::path& work,
                                    const std::filesystem::path& sdk);

}  // namespace btr::openr
