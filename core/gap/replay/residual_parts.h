#pragma once
// What residual and inverse scoring share.
#include "core/gap/replay/residual.h"

namespace btr {

/// The numbers of `error` from its series. `finer`: simulated with half the step, empty: not done.
void fillErrors(ChannelError& error, const std::vector<double>& finer);

/// The same note of many recordings is said once: "first.csv and 11 more: text".
void joinNotes(std::vector<std::string>& notes);

/// Makes the folder and writes one plot a channel, RECORDING.CHANNEL.svg. Throws InputError.
void writeOverlays(const std::string& folder, const std::vector<ChannelError>& channels);

}  // namespace btr
