#pragma once
#include <string>

#include "core/cluster/parts.h"
#include "core/gap/report/run_analysis.h"
#include "core/sim/worker_pool.h"

namespace btr {

/// An analysis that several processes make together (SharedAnalysis): each makes all of it, one after another, and the
/// jobs of each call of parallel() are divided among them. What rank 0 (→) and the foremen (←) say to each other:
///   →  analysis NUMBER REQUEST
///   ←  ready NUMBER WORKERS INPUTS IDENTITY...      INPUTS: packed, "NAME HASH" of what is read
///   →  begin JOBS                                    worker processes of all together
///   ←  call NUMBER COUNT                             it has come to this call, of so many jobs
///   →  jobs PIECE I...
///   ←  done PIECE SECONDS [STATE BYTES]...           STATE: R a reply, F why there is none, K the worker was killed
///   →  all NUMBER [I STATE BYTES]...                 what the others found; the call is over
///   ←  found HASH                                    of the report that it has come to
///   →  write                                         to one of them
///   ←  written PLAIN JSON                            the report as text
/// and at any time  ←  progress STAGE SHARE  and  ←  failed KIND WHY  with KIND input, fault or other.

/// Paths, as they were given, and what else decides; not what only the defaults of AnalysisOptions say.
std::string toJsonText(const AnalysisRequest& request);
/// Throws InputError.
AnalysisRequest analysisRequestFromJson(const std::string& text);

/// "NAME HASH" (SHA-256) of the files that a problem was read from, and of the numbers that came of its recordings.
Parts inputsOf(const AnalysisRequest& request, const GapProblem& problem);

/// STATE and BYTES of a reply, and back.
void append(Parts& parts, const WorkerPool::Reply& reply);
WorkerPool::Reply replyFrom(const std::string& state, const std::string& bytes);

}  // namespace btr
