#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"
#include "core/sim/bench/bench.h"

namespace btr::cli {

/// One figure of the table that `btr bench` prints.
struct BenchRow {
  std::string part;   ///< "walk", "database"
  std::string what;   ///< "CPU per simulated second"
  double value = 0;   ///< in `unit`; not a number: could not be measured, `note` says why
  std::string unit;   ///< "ms"
  std::string step;   ///< with which the world was stepped, "" where nothing was simulated
  std::string exact;  ///< how far from its converged outcome, or from what is asked
  std::string note;
};

/// What all parts need.
struct BenchWork {
  const PluginHost& host;
  std::string resources;  ///< folder of scenes/, experiments/, …
  std::string program;    ///< this one
  int repeats = 3;
  int individuals = 50'000;      ///< of the database
  double seconds = 20;           ///< of the running worlds, simulated
  std::function<bool()> goesOn;  ///< asked between trials
  std::function<void(const std::string&)> progress;
};

/// Rows of walk or kick: at the cheapest step, and there with libode's own solver, interleaved.
std::vector<BenchRow> taskRows(const BenchTask& task, const BenchResult& result, const BenchWork& work);
std::vector<BenchRow> setUpRows(const BenchTask& kick, const BenchWork& work);
std::vector<BenchRow> batchRows(const BenchWork& work);
std::vector<BenchRow> gapRows(const BenchWork& work);
std::vector<BenchRow> databaseRows(const BenchWork& work);
std::vector<BenchRow> liveRows(const BenchWork& work);
std::vector<BenchRow> mpiRows(const BenchWork& work);

std::string benchRowsTable(const std::vector<BenchRow>& rows);
nlohmann::json toJson(const BenchRow& row);
/// Processor, its count, and the load of the last minute: what figures depend on.
nlohmann::json benchMachine();

}  // namespace btr::cli
