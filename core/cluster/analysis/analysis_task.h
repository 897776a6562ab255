#pragma once
#include <functional>
#include <string>

#include "core/cluster/parts.h"
#include "core/gap/fit/gap_problem.h"
#include "core/plugin/plugin_host.h"

namespace btr {

/// What a foreman's analysis came to.
struct AnalysisOutcome {
  std::string hash;             ///< of all that must be the same whoever made it
  std::function<Parts()> tell;  ///< writes files, if some were asked for; what rank 0 gets to hear
};

/// What a foreman was told to analyse, as it read it.
struct AnalysisTask {
  Parts inputs;  ///< "NAME HASH" of what was read
  std::function<AnalysisOutcome(int jobs, const AnalysisProgress& progress)> analyse;
};

/// From the message "analysis" or "repair" (analysis_messages.h). `host` must outlive it. Throws InputError.
AnalysisTask analysisTaskFrom(const Parts& message, const PluginHost& host);

}  // namespace btr
