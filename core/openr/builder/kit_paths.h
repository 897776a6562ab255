#pragma once
#include <string>

namespace btr::openr {

/// Whether a Makefile's value is the folder in which a team had Sony's development kit, as "/usr/local/OPEN_R_SDK".
bool isKitFolder(const std::string& value);

/// A Makefile's text with every such folder, wherever it was, replaced by `kit`.
std::string withKitAt(const std::string& makefile, const std::string& kit);

}  // namespace btr::openr
