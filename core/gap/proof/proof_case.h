#pragma once
#include <string>

#include "core/gap/proof/proof_request.h"

namespace btr {

/// The name of a case's folder in the trial's: "case_007".
std::string nameOfCase(std::size_t number);
/// OUT/case_007/verdict.json: there once the case is finished.
std::string verdictOfCase(const std::string& out, std::size_t number);

/// One case from concealing to the opened seal, in its folder, which begins empty: the generator conceals, the seal is
/// kept, the recordings are analysed, the seal is opened and checked, the generator records further trials, in which
/// the error of what was found is measured. Throws InputError where the case cannot be made or written; an analysis
/// that fails is a finished case.
void proveCase(const ProofRequest& request, std::size_t number, const EffectLibrary& library, const Analyse& analyse);

}  // namespace btr
