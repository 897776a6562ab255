#pragma once
#include <string>
#include <vector>

namespace btr::openr {

/// The content of a file, unpacked if it is gzip's. At most 64 MiB. False if it cannot be read.
bool unpackedFile(const std::string& path, std::vector<char>& content);

}  // namespace btr::openr
