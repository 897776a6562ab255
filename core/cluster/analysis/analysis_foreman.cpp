#include "core/cluster/analysis/analysis_foreman.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <map>
#include <memory>

#include "core/cluster/analysis/analysis_messages.h"
#include "core/cluster/analysis/analysis_task.h"
#include "core/cluster/build_identity.h"
#include "core/gap/fit/job_share.h"
#include "core/gap/fit/parallel.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

bool canBeRead(const ForemanPipe& pipe) {
  pollfd file{pipe.in, POLLIN, 0};
  return poll(&file, 1, 0) > 0;
}

/// What rank 0 says while the analysis goes on.
class Inbox {
 public:
  Inbox(const ForemanPipe& pipe, std::string number) : pipe_(pipe), number_(std::move(number)) {}

  /// The next message; without anybody there, the process has nothing to live for. Throws Cancelled where nobody waits
  /// for this analysis any more.
  Parts next() {
    if (waiting_.empty()) read();
    Parts message = std::move(waiting_.front());
    waiting_.pop_front();
    if (isEnd(message)) throw Cancelled{};
    return message;
  }
  /// There is a message.
  bool hasNext() const { return !waiting_.empty() || canBeRead(pipe_); }
  /// Nobody waits for this analysis any more.
  bool isOver() {
    // What follows its end is not for this analysis.
    while ((waiting_.empty() || !isEnd(waiting_.back())) && canBeRead(pipe_)) read();
    return !waiting_.empty() && isEnd(waiting_.back());
  }

 private:
  void read() {
    auto message = pipe_.read();
    if (!message) _exit(0);
    if (!message->empty()) waiting_.push_back(std::move(*message));
  }
  bool isEnd(const Parts& message) const { return message.front() == "end" && message.at(1) == number_; }

  const ForemanPipe& pipe_;
  const std::string number_;
  std::deque<Parts> waiting_;
};

/// The calls of parallel() as rank 0 divides them.
class DividedCalls : public JobShare {
 public:
  DividedCalls(const ForemanPipe& pipe, Inbox& inbox, int workers) : pipe_(pipe), inbox_(inbox), workers_(workers) {}

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
        for (WorkerPool::Ended& ended : pool->wait(inbox_.hasNext() ? 0 : now_and_then_ms, pipe_.in)) {
          take(std::move(ended));
          if (goOn && !goOn(known_)) throw Cancelled{};
        }
        if (!inbox_.hasNext()) continue;
      }
      const Parts message = inbox_.next();
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
  Inbox& inbox_;
  int workers_;
  long call_ = 0;
  std::map<std::string, Piece> pieces_;  ///< by number; of the present call
  std::map<std::size_t, std::string> pieceOf_;
  std::vector<WorkerPool::Reply> replies_;
  std::size_t known_ = 0;
};

void takePart(const Parts& message, const ForemanPipe& pipe, const PluginHost& host, int ownWorkers) {
  const int told = std::stoi(message.at(2)), workers = told > 0 ? told : ownWorkers;
  const AnalysisTask task = analysisTaskFrom(message, host);
  pipe.write(joined({"ready", message[1], std::to_string(workers), pack(task.inputs)}, buildIdentity(host)));
  Inbox inbox(pipe, message[1]);
  Parts begin;
  do begin = inbox.next();
  while (begin[0] != "begin");
  DividedCalls calls(pipe, inbox, workers);
  const SharedJobs shared(calls);
  const AnalysisOutcome outcome = task.analyse(std::stoi(begin.at(1)), [&](const std::string& stage, double share) {
    pipe.write({"progress", stage, toText(share)});
    return !inbox.isOver();
  });
  pipe.write({"found", outcome.hash});
  while (inbox.next()[0] != "write") {
  }
  pipe.write(joined({"written"}, outcome.tell()));
}

}  // namespace

void serveAnalysis(const Parts& message, const ForemanPipe& pipe, const PluginHost& host, int workers) {
  const auto failed = [&](const char* kind, const std::exception& error) {
    pipe.write({"failed", message[1], kind, error.what()});
  };
  try {
    takePart(message, pipe, host, workers);
  } catch (const Cancelled&) {
    // nobody waits to hear of it
  } catch (const InputError& error) {
    failed("input", error);
  } catch (const JobFault& fault) {
    failed("fault", fault);
  } catch (const std::exception& error) {
    failed("other", error);
  }
}

}  // namespace btr
