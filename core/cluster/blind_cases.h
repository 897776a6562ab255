#pragma once
#include <string>

#include "core/gap/proof/proof_request.h"

namespace btr {

/// Proves a case in a folder of its own and returns what it came to, as bytes: for a process that works for another
/// machine. Throws as proveCase(), unless this machine has no room to write: then the bytes say so.
std::string proveAway(ProofRequest request, std::size_t number, const EffectLibrary& library);
/// Puts it into the trial's folder, whole or not at all. Throws InputError if it cannot be written, and if the bytes
/// say that the other machine had no room.
void takeCase(const std::string& out, std::size_t number, const std::string& bytes);

/// Where cases are proved (own_scratch.h).
constexpr const char* caseScratch = "case";

}  // namespace btr
