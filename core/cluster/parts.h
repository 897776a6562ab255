#pragma once
#include <string>
#include <vector>

namespace btr {

/// What the processes of a job say to each other: texts in a row, the first of them says what it is.
using Parts = std::vector<std::string>;

/// Each part's length (8 bytes, this machine's order: builds are the same everywhere) and its bytes.
std::string pack(const Parts& parts);
/// Throws InputError for bytes that pack() does not write.
Parts unpack(const std::string& bytes);

}  // namespace btr
