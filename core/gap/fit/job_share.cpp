#include "core/gap/fit/job_share.h"

namespace btr {
namespace {

JobShare* shareOfThisProcess = nullptr;

}  // namespace

SharedJobs::SharedJobs(JobShare& share) { shareOfThisProcess = &share; }

SharedJobs::~SharedJobs() { shareOfThisProcess = nullptr; }

JobShare* SharedJobs::now() { return shareOfThisProcess; }

}  // namespace btr
