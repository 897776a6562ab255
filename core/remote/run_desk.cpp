#include "core/remote/run_desk.h"

#include <cstdlib>

#include "core/remote/nursery.h"
#include "core/run/loop/back_to_reality.h"
#include "core/spec/error.h"

namespace btr::remote {

std::string RunDesk::answer(Method method, std::string_view message) {
  const auto number = toNumber(std::string(message));
  if (method != Method::work || !number) throw Refusal(Code::notThere, "a run does not answer this");
  constexpr int patience_ms = 60000;
  const Id run = static_cast<Id>(*number);
  setenv("UCHILSIM_LEARNER", std::to_string(Nursery::lineOfChild).c_str(), 1);
  Database db = Database::open(database_, Database::Mode::readWrite, patience_ms);
  const StopFlag never{false};
  RunOptions options;
  options.jobs = jobs_;
  options.earlierStopCounts = true;  // older ones were forgotten before this process was started
  try {
    const RunEnd end = continueRun(db, host_, run, never, options);
    return end == RunEnd::finished ? "finished" : end == RunEnd::waiting ? "waiting" : "stopped";
  } catch (const InputError& error) {
    // What is stored is sound; the run says why it stopped, unless another process works on it.
    if (!isRunActive(database_, run) && db.run(run).state != RunState::finished)
      db.setRunState(run, RunState::stopped, error.what());
    throw;
  }
}

}  // namespace btr::remote
