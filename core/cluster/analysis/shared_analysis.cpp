#include "core/cluster/analysis/shared_analysis.h"

#include <utility>

#include "core/cluster/analysis/analysis_messages.h"
#include "core/spec/error.h"

namespace btr {

SharedAnalysis::SharedAnalysis(std::unique_ptr<RankLink> link, const PluginHost& host, CoordinatorOptions options)
    : host_(host), ranks_(std::move(link), host, std::move(options)) {}

SharedAnalysis::Report SharedAnalysis::run(const AnalysisRequest& request, const AnalysisProgress& progress,
                                           const std::atomic<bool>& stop) {
  lockstep_ = std::make_unique<Lockstep>(ranks_, host_, Lockstep::Task{{"analysis", toJsonText(request)}});
  const Parts told = lockstep_->run(progress, [&stop] { return !stop; });
  if (told.size() != 2) throw InputError("the report of an analysis is cut short");
  return {told[0], told[1]};
}

std::vector<PlaceReport> SharedAnalysis::report() const {
  return lockstep_ ? lockstep_->report() : std::vector<PlaceReport>{};
}

std::vector<std::string> SharedAnalysis::notes() const {
  return lockstep_ ? lockstep_->notes() : std::vector<std::string>{};
}

}  // namespace btr
