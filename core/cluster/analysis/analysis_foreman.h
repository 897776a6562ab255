#pragma once
#include "core/cluster/foreman_pipe.h"
#include "core/plugin/plugin_host.h"

namespace btr {

/// A foreman's part in an analysis that all make together, from its first message on (analysis_messages.h), with so
/// many worker processes of its own unless the message says how many. Returns when the analysis ended here: it was
/// told, it failed and told that, or nobody waits for it any more.
void serveAnalysis(const Parts& message, const ForemanPipe& pipe, const PluginHost& host, int workers);

}  // namespace btr
