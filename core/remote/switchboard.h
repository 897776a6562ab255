#pragma once
#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/live/camera_eye.h"
#include "core/plugin/plugin_host.h"
#include "core/remote/games_folder.h"
#include "core/remote/nursery.h"
#include "core/remote/run_keeper.h"
#include "core/remote/stick_programs.h"

namespace btr::remote {

/// Passes calls on to the processes that answer them: each world, each evaluator, each run and the database has one of
/// its own. Knows nothing of networks. From any thread.
class Switchboard {
 public:
  struct Options {
    GamesFolder folder;
    std::string database{};  ///< "" for none
    int jobs = 0;            ///< worker processes of an evaluator, a run; 0: as many as processors
    int mostWorlds = 16;
    double patience_s = 60;         ///< of a call to a world, since it last said that it is at work
    CameraMaker cameras{};          ///< called in a world's process
    StickProgramsMaker programs{};  ///< the same
    double idle_s = 600;            ///< a world that nobody has called for so long is closed
  };
  using Cancelled = std::function<bool()>;

  /// Before this process has other threads. The host must outlive it. Throws InputError.
  Switchboard(Options options, const PluginHost& host);
  ~Switchboard();
  Switchboard(const Switchboard&) = delete;
  Switchboard& operator=(const Switchboard&) = delete;

  const Options& options() const { return options_; }
  const PluginHost& host() const { return host_; }
  RunKeeper& runs() { return *runs_; }

  /// `request` and answers are bytes of messages.
  Answer open(const std::string& request, const Cancelled& cancelled);
  /// What was begun is done, whether or not its caller still waits; `leaves`: a long step ends at its next period.
  Answer world(const std::string& name, const std::string& call, const Cancelled& cancelled = {},
               const Cancelled& leaves = {});
  Answer close(const std::string& name, const Cancelled& cancelled = {});
  std::vector<std::string> worlds() const;
  /// `key` is equal for calls that the same workers may answer. A call that is cancelled ends its evaluator's process;
  /// those that waited for it are answered by another.
  Answer evaluate(const std::string& key, const std::string& call, double patience_s, const Cancelled& cancelled);
  Answer records(const std::string& call, const Cancelled& cancelled = {});

 private:
  struct World {
    std::unique_ptr<Child> child;
    std::atomic<double> used_s{0};
    std::atomic<int> callers{0};
  };
  struct Evaluator {
    std::unique_ptr<Child> child;
    double used_s = 0;
    int callers = 0;
  };
  static constexpr std::size_t mostEvaluators = 4;

  void closeIdle();
  /// The evaluator of this key, with its callers counted. Throws Refusal.
  std::shared_ptr<Evaluator> evaluatorOf(const std::string& key);

  const Options options_;
  const PluginHost& host_;
  Nursery nursery_;
  std::unique_ptr<RunKeeper> runs_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<World>> worlds_;
  std::map<std::string, std::shared_ptr<Evaluator>> evaluators_;
  std::shared_ptr<Child> records_;
  std::condition_variable ends_;
  bool ending_ = false;
  std::thread janitor_;
};

}  // namespace btr::remote
