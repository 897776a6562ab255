#pragma once
#include <string>

namespace btr {

/// The beginning of a ScratchFolder's name that tells whose it is: "uchilsim-case-4711" of the process 4711.
std::string ownScratchName(const std::string& what);
/// Removes such folders of processes of this machine that were killed.
void removeAbandonedScratch(const std::string& what);

}  // namespace btr
