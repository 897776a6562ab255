#pragma once
#include "core/gap/fit/score.h"
#include "core/gap/search/thresholds.h"

namespace btr {

// Models compared by what both leave of blocks that they were not fitted to.

/// Whether a model without something predicts worse than the one with it.
bool isMissed(const Scored& without, const Scored& with, const SearchThresholds::Confirmation& limits);

/// What the effects of a model may leave of what they explain [noise floors²]: a named law is not in every detail the
/// plant's, and the more it takes the more the rest of it is above the noise. No further name is due to so little.
double imperfectionOf(const Scored& calibrated, const Scored& model, const SearchThresholds::Screening& limits);

/// Their comparison, but by how likely chance does as well: a shift in time that is as far as it may be stands for
/// something else. Where an effect does without it, what the shift hides is part of what the effect explains.
PairedTest besideAFarthestShift(PairedTest comparison, const Scored& without, const Scored& with,
                                const SearchThresholds::Shift& limits);

/// Another model is no rival, by its comparison (without) with the final one (with).
bool isWorse(const PairedTest& lost, const SearchThresholds::Rivals& limits);
/// The same where the other may explain all but the noise already: what takes a few percent of the noise itself
/// (sensors of counts are no dice) does not refute it.
bool isRefuted(const Scored& other, const Scored& by, const SearchThresholds::Rivals& limits);
/// Predicts worse and fits worse. What fits as well and predicts worse only pays for a number more: recordings that it
/// explains as well do not distinguish it from the final model.
bool isDistinguished(const Scored& other, const Scored& final, const SearchThresholds::Rivals& limits);

/// Whether a size is known from below only, as of friction that holds a joint: one `largerSize` times as large costs
/// the same, by what it takes. Costs without it, as fitted, and larger.
bool isKnownFromBelow(double without, double fitted, double larger, const SearchThresholds::Confirmation& limits);

}  // namespace btr
