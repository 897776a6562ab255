#pragma once
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/run/grid/grid.h"
#include "core/run/grid/grid_cells.h"
#include "core/run/loop/search.h"

// The parts of a grid's work, for the sources that do it.
namespace btr {

/// An individual that a cell has tried.
struct Tried {
  double fitness = 0;
  Id id = 0;
  std::vector<double> parameters;
};

/// A learning cell while this process works on it.
struct CellWork {
  const GridCell* cell = nullptr;
  Id run = 0;
  std::unique_ptr<PreparedExperiment> prepared;
  std::unique_ptr<Search> search;
  std::vector<Tried> tried;  ///< distinct ones, best first, the earlier of equals first
};

/// What the phases of one grid share while a process works on it. Belongs to one thread.
class GridWork {
 public:
  GridWork(Database& database, const PluginHost& host, Id grid, const StopFlag& stop, const GridOptions& options);

  /// Each brings its phase to its end, or finds it there; false if stopped.
  bool learn();   ///< grid_learning.cpp
  bool settle();  ///< grid_settling.cpp: failed cells, then mirrored ones
  bool tryPoints();

  GridProgress progress;
  void publish(bool now);

 private:
  double setting(const std::string& name) const;
  const GridCell& cell(int number) const { return cells_[static_cast<std::size_t>(number - 1)]; }
  /// The cell that learns for this one: itself or the one that it mirrors.
  int learnerOf(int number) const { return cell(number).mirrorOf ? cell(number).mirrorOf : number; }
  std::vector<double> imageIf(bool mirrored, const std::vector<double>& parameters) const;
  bool stopped();
  std::optional<std::vector<TrialReply>> evaluate(const std::vector<TrialJob>& jobs);
  TrialJob jobOf(std::span<const double, 3> task, std::vector<double> parameters) const;

  bool learnWave(const std::vector<int>& wave);
  void beginWave(const std::vector<int>& wave);
  CellWork resume(int number) const;
  bool round(std::vector<CellWork>& wave);
  /// Mean similarity to the present bests of the cell's neighbours; 1 if none of them has one.
  double similarityAt(const GridCell& cell, std::span<const double> parameters) const;
  double worth(double fitness, double similarity) const;

  bool settleLearned();
  bool settleMirrored();
  GenerationRecord generationOf(Id run, const std::vector<std::vector<double>>& parameters,
                                std::span<const TrialReply> replies) const;

  Database& db_;
  const PluginHost& host_;
  const StopFlag& stop_;
  const GridOptions& options_;
  std::atomic<bool> halt_{false};
  GridRecord record_;
  GridSpec spec_;
  GridSpec::Method method_;
  std::vector<GridCell> cells_;
  PreparedExperiment base_;  ///< any cell's: the task stands in each job
  SimulatorSpec simulator_;
  std::unique_ptr<Evaluator> evaluator_;
  std::map<int, Tried> best_;  ///< of learning cells that have one
  std::chrono::steady_clock::time_point begun_, published_, looked_;
};

/// The run that begins for a cell.
GridStart gridStart(const PreparedExperiment& base, const GridSpec& spec, GridSpec::Method method, Id experiment,
                    std::uint64_t seed, const GridCell& cell, const std::optional<SearchStart>& start);

}  // namespace btr
