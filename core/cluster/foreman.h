#pragma once
#include "core/plugin/plugin_host.h"

namespace btr {

/// The process that works for a rank: it reads on standard input what is to be done, has it done by a worker process of
/// its own, which it replaces when it dies or hangs, and writes the results to standard output, until its input ends.
/// A message is its length (8 bytes) and packed parts:
///   →  experiment NUMBER SPEC SCENE [NAME HASH CONTENT]...      cases NUMBER REQUEST      piece NUMBER JOB...
///   ←  hello IDENTITY...      ready NUMBER IDENTITY...      refused NUMBER WHY
///      done NUMBER SECONDS [STATE BYTES]...   STATE: R a reply, F why there is none, K the worker was killed
/// Jobs are trials of the experiment (Evaluator), or the numbers of blind cases (blind_cases.h) as they are asked for
/// in REQUEST (proof_request.h). What plugins write to standard output goes to standard error. What is said of an
/// analysis that all foremen make together, with `workers` processes each, is in analysis_foreman.h.
void servePieces(const PluginHost& host, double secondsPerJob, int workers = 1);

}  // namespace btr
