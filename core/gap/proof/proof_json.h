#pragma once
#include <string>
#include <vector>

#include "core/gap/proof/proof_score.h"
#include "core/gap/proof/proved_case.h"

namespace btr {

std::string toJsonText(const ProvedCase& proved);
ProvedCase provedFromJson(const std::string& text, const std::string& place);

/// The score for programs ("uchilsim-proof-2").
std::string proofJson(const ProofScore& score, const std::vector<ProvedCase>& cases);

}  // namespace btr
