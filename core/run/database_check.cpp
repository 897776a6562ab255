#include "core/run/database_check.h"

#include <algorithm>

#include "core/run/replay.h"
#include "core/spec/error.h"

namespace btr {
namespace {

std::string nameOf(Id run, const IndividualRecord& individual) {
  return "run " + std::to_string(run) + ", individual " + std::to_string(individual.id);
}

}  // namespace

DatabaseCheck checkDatabase(const Database& database, const PluginHost& host, int replaysOfEachRun,
                            const StopFlag& stop) {
  DatabaseCheck check;
  check.findings = database.findings();
  for (const RunRecord& run : database.runs()) {
    const std::vector<IndividualRecord> all = database.individuals(run.id);
    const std::size_t wanted = std::min(all.size(), static_cast<std::size_t>(replaysOfEachRun));
    for (std::size_t k = 0; k < wanted; ++k) {
      if (stop) {
        check.stopped = true;
        return check;
      }
      const IndividualRecord& individual = all[wanted == 1 ? 0 : k * (all.size() - 1) / (wanted - 1)];
      ++check.replays;
      try {
        if (replay(database, host, run.id, individual.id).identical)
          ++check.identical;
        else
          check.findings.push_back(nameOf(run.id, individual) + ": the replay differs from what is stored");
      } catch (const InputError& error) {
        check.findings.push_back(nameOf(run.id, individual) + ": cannot be replayed (" + error.what() + ")");
      }
    }
  }
  return check;
}

}  // namespace btr
