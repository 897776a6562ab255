#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "core/gap/proof/proof_request.h"
#include "core/gap/proof/proved_case.h"

namespace btr {

/// Lets the generator conceal, keeps the seal, analyses, writes the verdict, opens the seal and checks it, lets the
/// generator record further trials and measures the error of what was found in them, case by case; then proof.json,
/// proof.txt and proof.html of all finished cases. Each finished case is in OUT/case_NNN/verdict.json and is not
/// repeated. A raised `stop` ends it early with what is finished. `progress(done, all)` is called after each case.
/// Throws InputError for a generator that is not there, for a folder of another trial and, after all others are
/// counted, for cases that the generator failed to make.
std::vector<ProvedCase> runProof(const ProofRequest& request, const EffectLibrary& library, const Analyse& analyse,
                                 const std::atomic<bool>& stop,
                                 const std::function<void(std::size_t, std::size_t)>& progress = {});

/// The cases that are asked for and not finished yet, ascending; the folder is made, and is the trial's from now on.
/// Throws InputError for a folder of another trial.
std::vector<std::size_t> openCases(const ProofRequest& request);

/// $UCHILSIM_CONCEAL, else `conceal` beside the running program. Throws InputError that says how to build it.
std::string findGenerator();

}  // namespace btr
