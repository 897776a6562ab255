#pragma once
#include <string>
#include <vector>

#include "core/gap/proof/proof_score.h"
#include "core/gap/proof/proved_case.h"

namespace btr {

/// The finished cases of a blind trial: of its folder (OUT of `btr gap prove`), by number, or of a file that linesOf()
/// wrote. Throws InputError for a path with no case in it and for a damaged one.
std::vector<ProvedCase> provedCasesIn(const std::string& path);
/// The same of several, in their order. Throws InputError for a case that is there twice.
std::vector<ProvedCase> provedCasesIn(const std::vector<std::string>& paths);

/// One case a line, so that a trial can be carried without its recordings and counted again.
std::string linesOf(const std::vector<ProvedCase>& cases);

/// proof.json, proof.txt and proof.html. `total`: score(cases).
void writeProof(const std::string& folder, const ProofScore& total, const std::vector<ProvedCase>& cases);

}  // namespace btr
