#pragma once
#include <functional>
#include <optional>

#include "core/gap/recordings/recording.h"
#include "core/gap/replay/start_state.h"
#include "core/gap/replay/trial_scenes.h"
#include "core/sim/scene.h"

namespace btr {

/// Where a trial begins, fitted to its samples in the simulator as it is: as in a report, where the start of each trial
/// belongs to what is fitted, of held-out ones too. Over the whole trial; of a tossed body, whose impacts multiply an
/// error, over its first window, of what swings freely over its first second, and of a servo, which forgets, over five.
/// Nothing where the recording says nothing of its start: no measured channel with numbers, fewer than eight rows, a
/// motion that is prescribed. Throws InputError, and Cancelled when `goesOn` says no.
std::optional<StartState> fittedStart(const TrialScenes& scenes, const EffectFactory& effects, const Recording& trial,
                                      const std::function<bool()>& goesOn = {});

}  // namespace btr
