#pragma once
#include <string>

#include "core/cluster/parts.h"
#include "core/gap/report/run_analysis.h"
#include "core/run/reality/recorded_analysis.h"
#include "core/sim/worker_pool.h"

namespace btr {

/// An analysis that several processes make together (Lockstep): each makes all of it, one after another, and the jobs
/// of each call of parallel() are divided among them. What rank 0 (→) and the foremen (←) say to each other:
///   →  analysis NUMBER WORKERS REQUEST               of files, as `btr gap analyse` is asked for it
///   →  repair NUMBER WORKERS RECORDINGS EXPERIMENT…  a run's own: packed (pack(RecordedAnalysis)), and
///                                                    experimentParts(). WORKERS: its worker processes, 0: as it knows
///   ←  ready NUMBER WORKERS INPUTS IDENTITY...       INPUTS: packed, "NAME HASH" of what is read
///   →  begin JOBS                                    worker processes of all together
///   ←  call NUMBER COUNT                             it has come to this call, of so many jobs
///   →  jobs PIECE I...
///   ←  done PIECE SECONDS [STATE BYTES]...           STATE: R a reply, F why there is none, K the worker was killed
///   →  all NUMBER [I STATE BYTES]...                 what the others found; the call is over
///   ←  found HASH                                    of what it has come to
///   →  write                                         to one of them
///   ←  written TEXT...                               of files: the report, plain and JSON; of a run: its finding
///   →  end NUMBER                                    nobody waits for it any more
/// and at any time  ←  progress STAGE SHARE  and  ←  failed NUMBER KIND WHY  with KIND input, fault or other.

/// Whether this is what an analysis begins with.
bool isAnalysis(const Parts& message);

/// Paths, as they were given, and what else decides; not what only the defaults of AnalysisOptions say.
std::string toJsonText(const AnalysisRequest& request);
/// Throws InputError.
AnalysisRequest analysisRequestFromJson(const std::string& text);

std::string pack(const RecordedAnalysis& analysis);
/// Throws InputError.
RecordedAnalysis recordedAnalysisFrom(const std::string& bytes);

Parts partsOf(const RecordedFinding& finding);
/// Throws InputError.
RecordedFinding findingFrom(const Parts& parts);

/// "NAME HASH" (SHA-256) of the files that a problem was read from, and of the numbers that came of its recordings.
Parts inputsOf(const AnalysisRequest& request, const GapProblem& problem);
/// Of a run's analysis: of its recordings.
Parts inputsOf(const GapProblem& problem);

/// STATE and BYTES of a reply, and back.
void append(Parts& parts, const WorkerPool::Reply& reply);
WorkerPool::Reply replyFrom(const std::string& state, const std::string& bytes);

}  // namespace btr
