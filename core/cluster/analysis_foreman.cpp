#include "core/cluster/analysis_foreman.h"

#include <poll.h>
#include <unistd.h>

#include <map>
#include <memory>

#include "core/cluster/analysis_messages.h"
#include "core/cluster/build_identity.h"
#include "core/gap/fit/job_share.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/report/report_files.h"
#include "core/gap/report/report_json.h"
#include "core/gap/report/report_plain.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"
#include "core/spec/sha256.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

/// The next message; without anybody there, the process has nothing to live for.
Parts nextMessage(const ForemanPipe& pipe) {
  while (auto message = pipe.read())
    if (!message->empty()) return std::move(*message);
  _exit(0);
}

bool canBeRead(const ForemanPipe& pipe) {
  pollfd file{pipe.in, POLLIN, 0};
  return poll(&file, 1, 0) > 0;
}

/// The calls of parallel() as rank 0 divides them.
class DividedCalls : public JobShare {
 public:
  DividedCalls(const ForemanPipe& pipe, int workers) : pipe_(pipe), workers_(workers) {}

  std::vector<WorkerPool::Reply> run(std::size_t count, const std::function<std::string(std::size_t)>& work,
                                     const std::function<bool(std::size_t)>& goOn) override {
    ++call_;
    pieces_.clear();
    pieceOf_.clear();
    replies_.assign(count, {});
    known_ = 0;
    std::unique_ptr<WorkerPool> pool;  // once there is something to do
    pipe_.write({"call", std::to_string(call_), std::to_string(count)});
    while (true) {
      if (pool) {
        constexpr int now_and_then_ms = 1000;
        for (WorkerPool::Ended& ended : pool->wait(now_and_then_ms, pipe_.in)) {
          take(std::move(ended));
          if (goOn && !goOn(known_)) throw Cancelled{};
        }
        if (!canBeRead(pipe_)) continue;
      }
      const Parts message = nextMessage(pipe_);
      if (message[0] == "all" && message.at(1) == std::to_string(call_)) {
        for (std::size_t i = 2; i + 2 < message.size(); i += 3)
          replies_.at(std::stoul(message[i])) = replyFrom(message[i + 1], message[i + 2]);
        if (goOn && !goOn(count)) throw Cancelled{};
        return std::move(replies_);
      }
      if (message[0] != "jobs") continue;
      if (!pool)
        pool = std::make_unique<WorkerPool>(
            std::min(workers_, static_cast<int>(count)), [&](const std::string& job) { return work(std::stoul(job)); },
            longestAnalysisJob_s);
      Piece& piece = pieces_[message.at(1)];
      for (std::size_t i = 2; i < message.size(); ++i) {
        const std::size_t job = std::stoul(message[i]);
        piece.jobs.push_back(job);
        pieceOf_[job] = message[1];
        pool->add(job, message[i]);
      }
      piece.open = piece.jobs.size();
    }
  }

 private:
  struct Piece {
    std::vector<std::size_t> jobs;
    std::size_t open = 0;
    double worked_s = 0;
  };

  void take(WorkerPool::Ended ended) {
    const std::string number = pieceOf_.at(ended.number);
    Piece& piece = pieces_.at(number);
    replies_.at(ended.number) = std::move(ended.reply);
    ++known_;
    piece.worked_s += ended.seconds;
    if (--piece.open > 0) return;
    Parts answer{"done", number, toText(piece.worked_s)};
    for (const std::size_t job : piece.jobs) append(answer, replies_[job]);
    pipe_.write(answer);
    pieces_.erase(number);
  }

  const ForemanPipe& pipe_;
  int workers_;
  long call_ = 0;
  std::map<std::string, Piece> pieces_;  ///< by number; of the present call
  std::map<std::size_t, std::string> pieceOf_;
  std::vector<WorkerPool::Reply> replies_;
  std::size_t known_ = 0;
};

/// Of all that must be the same whoever made it.
std::string hashOf(GapReport report) {
  report.seconds = 0;
  return sha256(toJsonText(report));
}

void takePart(const Parts& message, const ForemanPipe& pipe, const PluginHost& host, int workers) {
  AnalysisRequest request = analysisRequestFromJson(message.at(2));
  const EffectLibrary library{host.effectFactory(), host.effects()};
  refuseUnknownEffects(request.options, library);
  const GapProblem problem = loadProblem(request);
  pipe.write(
      joined({"ready", message[1], std::to_string(workers), pack(inputsOf(request, problem))}, buildIdentity(host)));
  for (Parts begin = nextMessage(pipe);; begin = nextMessage(pipe))
    if (begin[0] == "begin") {
      request.options.jobs = std::stoi(begin.at(1));
      break;
    }
  DividedCalls calls(pipe, workers);
  const SharedJobs shared(calls);
  const GapReport report = analyseLoaded(request, problem, library, [&](const std::string& stage, double share) {
    pipe.write({"progress", stage, toText(share)});
    return true;
  });
  pipe.write({"found", hashOf(report)});
  while (nextMessage(pipe)[0] != "write") {
  }
  if (!request.out.empty()) writeReport(report, request.out);
  pipe.write({"written", toPlainText(report), toJsonText(report)});
}

}  // namespace

void serveAnalysis(const Parts& message, const ForemanPipe& pipe, const PluginHost& host, int workers) {
  try {
    takePart(message, pipe, host, workers);
  } catch (const InputError& error) {
    pipe.write({"failed", "input", error.what()});
  } catch (const JobFault& fault) {
    pipe.write({"failed", "fault", fault.what()});
  } catch (const std::exception& error) {
    pipe.write({"failed", "other", error.what()});
  }
}

}  // namespace btr
