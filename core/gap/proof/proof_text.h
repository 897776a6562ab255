#pragma once
#include <string>

#include "core/gap/proof/proof_score.h"

namespace btr {

/// The score for people, in a terminal and as a self-contained page.
std::string proofText(const ProofScore& score);
std::string proofHtml(const ProofScore& score);

}  // namespace btr
