#include "core/remote/switchboard.h"

#include <sys/random.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>

#include "core/remote/clock.h"
#include "core/remote/evaluation_desk.h"
#include "core/remote/records_desk.h"
#include "core/remote/run_desk.h"
#include "core/remote/world_desk.h"
#include "core/spec/error.h"
#include "uchilsim.pb.h"

namespace btr::remote {
namespace {

/// 16 letters that nobody guesses.
std::string newName() {
  unsigned char bytes[8];
  if (getrandom(bytes, sizeof bytes, 0) != sizeof bytes) throw Refusal(Code::internal, "no random numbers");
  std::string name;
  for (const unsigned char byte : bytes)
    for (const int half : {byte >> 4, byte & 15}) name += "0123456789abcdef"[half];
  return name;
}

/// A world that a client blew up ends alone. An evaluator has no such limit: it only hands trials to its workers.
void limitMemory() {
#if !defined(__SANITIZE_ADDRESS__)
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
  return;
#endif
#endif
  constexpr rlim_t most = 4ull << 30;
  const rlimit limit{most, most};
  setrlimit(RLIMIT_AS, &limit);
#endif
}

/// What strangers send is answered, not written to the operator's terminal.
void beSilent() { google::protobuf::SetLogHandler(nullptr); }

Nursery::Life lifeOf(const Switchboard::Options& options, const PluginHost& host) {
  return [&options, &host](char kind) {
    const auto answer = [](Desk&& desk) {
      constexpr double beat_s = 1;
      serve(desk, Nursery::socketOfChild, beat_s, Child::isToLeave);
    };
    if (kind == 'w') limitMemory();
    if (kind == 'w') answer(WorldDesk(host, options.folder, options.cameras, options.programs));
    if (kind == 'e') answer(EvaluationDesk(host, options.folder, options.database, options.jobs));
    if (kind == 'd') answer(RecordsDesk(host, options.folder, options.database));
    if (kind == 'r') answer(RunDesk(host, options.database, options.jobs));
  };
}

}  // namespace

Switchboard::Switchboard(Options options, const PluginHost& host)
    : options_((beSilent(), std::move(options))),
      host_(host),
      nursery_(lifeOf(options_, host)),
      runs_(std::make_unique<RunKeeper>(nursery_)),
      janitor_([this] { closeIdle(); }) {}

Switchboard::~Switchboard() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ends_.notify_all();
  janitor_.join();
  for (const std::string& name : worlds()) close(name);
  // A run looks once a second whether it is to stop. One that does not in time is ended, which loses at most the trials
  // of one generation.
  constexpr double patience_s = 3;
  runs_->stopAll(
      [this](Id run) {
        uchilsim::v1::StopRequest request;
        request.set_run(run);
        records(callOf(Method::stop, request.SerializeAsString()));
      },
      patience_s);
}

void Switchboard::closeIdle() {
  std::unique_lock lock(mutex_);
  while (!ends_.wait_for(lock, std::chrono::seconds(1), [this] { return ending_; })) {
    const double now = now_s();
    std::vector<std::string> idle;
    for (const auto& [name, world] : worlds_)
      if (world->callers == 0 && (now - world->used_s > options_.idle_s || !world->child->alive()))
        idle.push_back(name);
    std::erase_if(evaluators_, [&](const auto& each) {
      return each.second->callers == 0 && (now - each.second->used_s > options_.idle_s || !each.second->child->alive());
    });
    lock.unlock();
    for (const std::string& name : idle) close(name);
    lock.lock();
  }
}

Answer Switchboard::open(const std::string& request, const Cancelled& cancelled) {
  const std::string name = newName();
  auto world = std::make_shared<World>();
  world->used_s = now_s();
  world->callers = 1;
  {
    const std::lock_guard lock(mutex_);
    if (worlds_.size() >= static_cast<std::size_t>(options_.mostWorlds))
      return {Code::tooMuch,
              "this server has " + std::to_string(worlds_.size()) + " worlds already, and may have no more; close one"};
    world->child = nursery_.start('w');
    worlds_[name] = world;
  }
  Answer answer = world->child->ask(callOf(Method::open, name + request), {options_.patience_s, cancelled});
  world->used_s = now_s();
  world->callers = 0;
  if (answer.code != Code::ok) {
    const std::lock_guard lock(mutex_);
    worlds_.erase(name);
  }
  return answer;
}

Answer Switchboard::world(const std::string& name, const std::string& call, const Cancelled& cancelled,
                          const Cancelled& leaves) {
  std::shared_ptr<World> world;
  {
    const std::lock_guard lock(mutex_);
    const auto found = worlds_.find(name);
    if (found == worlds_.end()) return {Code::notFound, "this server has no such world; it may have been closed"};
    world = found->second;
    ++world->callers;
  }
  Answer answer = world->child->ask(call, {options_.patience_s, cancelled, true, leaves});
  world->used_s = now_s();
  --world->callers;
  if (!world->child->alive()) answer.bytes = "the world has ended: " + answer.bytes;
  return answer;
}

Answer Switchboard::close(const std::string& name, const Cancelled& cancelled) {
  std::shared_ptr<World> world;
  {
    const std::lock_guard lock(mutex_);
    const auto found = worlds_.find(name);
    if (found == worlds_.end()) return {Code::notFound, "this server has no such world; it may have been closed"};
    world = found->second;
    worlds_.erase(found);
  }
  constexpr double patience_s = 5;
  return world->child->ask(callOf(Method::close, ""), {patience_s, cancelled, true});
}

std::vector<std::string> Switchboard::worlds() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const auto& [name, world] : worlds_) names.push_back(name);
  return names;
}

std::shared_ptr<Switchboard::Evaluator> Switchboard::evaluatorOf(const std::string& key) {
  std::shared_ptr<Evaluator> evaluator, oldest;  // `oldest` ends outside of the lock, before the call begins
  const std::lock_guard lock(mutex_);
  auto found = evaluators_.find(key);
  if (found != evaluators_.end() && !found->second->child->alive()) {
    evaluators_.erase(found);
    found = evaluators_.end();
  }
  if (found == evaluators_.end()) {
    if (evaluators_.size() >= mostEvaluators) {
      auto least = evaluators_.end();
      for (auto each = evaluators_.begin(); each != evaluators_.end(); ++each)
        if (each->second->callers == 0 && (least == evaluators_.end() || each->second->used_s < least->second->used_s))
          least = each;
      if (least == evaluators_.end())
        throw Refusal(Code::tooMuch,
                      "this server evaluates " + std::to_string(mostEvaluators) + " experiments already");
      oldest = least->second;
      evaluators_.erase(least);
    }
    auto fresh = std::make_shared<Evaluator>();
    fresh->child = nursery_.start('e');
    found = evaluators_.emplace(key, std::move(fresh)).first;
  }
  evaluator = found->second;
  ++evaluator->callers;
  return evaluator;
}

Answer Switchboard::evaluate(const std::string& key, const std::string& call, double patience_s,
                             const Cancelled& cancelled) {
  // Further rounds begin with an evaluator that somebody else's call has ended, one with a process that has died.
  bool mayDie = true;
  while (true) {
    const std::shared_ptr<Evaluator> evaluator = evaluatorOf(key);
    const Answer answer = evaluator->child->ask(call, {patience_s, cancelled});
    const std::lock_guard lock(mutex_);
    --evaluator->callers;
    evaluator->used_s = now_s();
    if (answer.code == Code::unavailable && answer.begun && std::exchange(mayDie, false)) continue;
    if (answer.begun || answer.code == Code::cancelled) return answer;
  }
}

Answer Switchboard::records(const std::string& call, const Cancelled& cancelled) {
  while (true) {
    std::shared_ptr<Child> records;
    {
      const std::lock_guard lock(mutex_);
      if (!records_ || !records_->alive()) records_ = nursery_.start('d');
      records = records_;
    }
    const Answer answer = records->ask(call, {options_.patience_s, cancelled, true});
    if (answer.begun || answer.code == Code::cancelled) return answer;
  }
}

}  // namespace btr::remote
