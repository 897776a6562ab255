#pragma once
#include "core/cluster/foreman_pipe.h"
#include "core/plugin/plugin_host.h"

namespace btr {

/// A foreman's part in an analysis that all make together, from the message "analysis" on (analysis_messages.h), with
/// so many worker processes of its own. Returns when the analysis ended here: with a report, or in a failure that it
/// told.
void serveAnalysis(const Parts& message, const ForemanPipe& pipe, const PluginHost& host, int workers);

}  // namespace btr
