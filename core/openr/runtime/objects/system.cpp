#include "core/openr/runtime/objects/system.h"

#include <OPENR/OPENRMessages.h>

#include <algorithm>
#include <cstring>

#include "core/openr/runtime/process/faults.h"
#include "core/openr/runtime/robot/services.h"

namespace btr::openr {
namespace {

System* theSystem = nullptr;

/// So many messages are handled in one frame of 8 ms; the others wait for the next, so that objects that answer each
/// other without end let time pass.
constexpr int messagesPerFrame = 2000;
/// More than this is not printed in one frame.
constexpr std::size_t printedPerFrame = 1u << 20;

template <class T>
void setParameter(OReasonMessage& message, const T& parameter) {
  static_assert(sizeof(T) <= oreasonPARAM_MAX_SIZE);
  message.paramSize = sizeof(T);
  std::memcpy(message.param, &parameter, sizeof(T));
}

}  // namespace

std::string RunningObject::methodName(Selector selector) const {
  if (selector < methods.size()) return methods[selector];
  static const char* const hooks[] = {"DoInit", "DoStart", "DoStop", "DoDestroy"};
  if (selector < 4) return hooks[selector];
  return selector == UNDEF ? "its global constructors" : "entry " + std::to_string(selector);
}

System::System(const RobotDesign& robot, std::string folder) : design(robot), stick(std::move(folder)) {
  theSystem = this;
  services_ = std::make_unique<Services>(*this);
  stdin_ = stdin;
  stdout_ = stdout;
  stderr_ = stderr;
}

System::~System() { theSystem = nullptr; }

OID System::oidOf(int index) {
  return OID(reinterpret_cast<void*>(static_cast<std::uintptr_t>(0x1000) * static_cast<std::uintptr_t>(index + 1)));
}

System& System::instance() { return *theSystem; }

bool theSystemIsThere() { return theSystem != nullptr; }

RunningObject& System::addNative(const std::string& name, std::function<void(Selector, void*)> handler) {
  auto added = std::make_unique<RunningObject>();
  added->index = static_cast<int>(objects_.size());
  added->oid = oidOf(added->index);
  added->name = name;
  added->native = std::move(handler);
  added->priorityClass = 16;
  objects_.push_back(std::move(added));
  return *objects_.back();
}

RunningObject* System::objectOf(const OID& oid) {
  for (const auto& object : objects_)
    if (object->oid == oid) return object.get();
  return nullptr;
}

void System::send(const OServiceEntry& to, std::shared_ptr<void> content) {
  RunningObject* object = objectOf(to.oid);
  if (object == nullptr) return;
  object->mailbox.push_back({++order_, to.selector, std::move(content)});
}

void System::sendToAll(Selector selector, OReason reason) {
  for (const auto& object : objects_) {
    if (object->native || object->entries.empty()) continue;
    auto message = std::make_shared<OReasonMessage>();
    message->reason = reason;
    if (reason == oreasonBOOT)
      setParameter(*message, OBootParam(omemorystickWRITABLE));
    else
      setParameter(*message, OShutdownParam(true));
    send(OServiceEntry(object->oid, selector), message);
  }
}

// ---- methods and their stacks -----------------------------------------------------------------------------------

void System::enter(RunningObject& object) {
  stdin = object.in;
  stdout = object.out;
  stderr = object.err;
}

void System::leave() {
  current_ = nullptr;
  stdin = stdin_;
  stdout = stdout_;
  stderr = stderr_;
}

void System::objectMain() {
  System& system = instance();
  numbersTrap();
  for (;;) {
    RunningObject& object = *system.current_;
    const auto entry = object.entries.find(object.running.selector);
    bool thrown = false;
    if (setjmp(object.methodEnd) == 0 && entry != object.entries.end()) {
      try {
        entry->second(object.running.content.get());
      } catch (...) {
        thrown = true;
      }
    }
    if (thrown)
      system.end(Ended::Why::crash, object.name, object.methodName(object.running.selector),
                 "it threw an exception that nobody caught");
    object.busy = false;
    swapcontext(&object.context, &system.main_);
  }
}

/// Goes on with the object's method until that ends or waits.
void System::run(RunningObject& object) {
  if (!object.started) {
    getcontext(&object.context);
    object.context.uc_stack.ss_sp = object.stack;
    object.context.uc_stack.ss_size = stackBytes;
    object.context.uc_link = nullptr;
    makecontext(&object.context, &System::objectMain, 0);
    object.started = true;
  }
  FaultState& fault = faultState();
  fault.object = &object;
  fault.selector = object.running.selector;
  setMethod(fault, object.methodName(object.running.selector));
  ++fault.serial;
  if (sigsetjmp(fault.home, 1) == 0) {
    current_ = &object;
    enter(object);
    fault.inMethod = true;
    swapcontext(&main_, &object.context);
    fault.inMethod = false;
    leave();
  } else {
    fault.inMethod = false;
    leave();
    end(fault.endless ? Ended::Why::endlessLoop : Ended::Why::crash, object.name,
        object.methodName(object.running.selector), fault.what);
  }
  if (!object.busy) object.running = {};
}

bool System::waitUntil(std::function<bool()> condition) {
  if (condition()) return true;
  RunningObject* object = current_;
  if (object == nullptr || !object->busy) return false;
  if (!object->line.empty()) flushLine(*object);
  object->wakes = std::move(condition);
  swapcontext(&object->context, &main_);
  return true;
}

std::int64_t System::readClock_us() {
  constexpr int most = 1000;  // more than measuring how long one's parts take needs in a frame
  const std::int64_t now = time_us();
  if (clockReads_.by != current_ || clockReads_.at_us != now) clockReads_ = {current_, now, 0};
  if (++clockReads_.count > most) waitUntil([this, now] { return time_us() > now; });
  return time_us();
}

void System::endMethod() {
  if (!current_->line.empty()) flushLine(*current_);
  if (current_->busy) longjmp(current_->methodEnd, 1);
  faultState().what = "they called exit() or abort()";  // global constructors
  siglongjmp(faultState().home, 1);
}

RunningObject* System::next() {
  RunningObject* best = nullptr;
  const auto order = [](const RunningObject& object) { return object.busy ? 0 : object.mailbox.front().order; };
  for (const auto& object : objects_) {
    if (object->busy ? !(object->wakes && object->wakes()) : object->mailbox.empty()) continue;
    if (best == nullptr || object->priorityClass > best->priorityClass ||
        (object->priorityClass == best->priorityClass && order(*object) < order(*best)))
      best = object.get();
  }
  return best;
}

void System::pump() {
  for (int left = messagesPerFrame; left > 0 && !ended_; --left) {
    RunningObject* object = next();
    if (object == nullptr) {
      if (!advance()) return;
      continue;
    }
    if (object->busy) {
      object->wakes = nullptr;
      run(*object);
      continue;
    }
    object->running = std::move(object->mailbox.front());
    object->mailbox.pop_front();
    if (object->native) {
      object->native(object->running.selector, object->running.content.get());
      object->running = {};
      continue;
    }
    object->busy = true;
    run(*object);
  }
}

bool System::quiet() const {
  return std::all_of(objects_.begin(), objects_.end(),
                     [](const auto& object) { return !object->busy && object->mailbox.empty(); });
}

/// Begins the next part of a program's life once all has come to rest. False if there is nothing to begin.
bool System::advance() {
  const bool stopping = phase_ == Phase::stop || phase_ == Phase::destroy;
  if (!quiet() && !stopping) return false;
  switch (phase_) {
    case Phase::load:
      sendToAll(oentryINIT, oreasonBOOT);
      phase_ = Phase::init;
      return true;
    case Phase::init:
      connect();
      phase_ = Phase::control;
      return true;
    case Phase::control:
      connectObservers();
      phase_ = Phase::connect;
      return true;
    case Phase::connect:
      services_->begin();
      phase_ = Phase::start;
      return true;
    case Phase::start:
      sendToAll(oentrySTART, oreasonBOOT);
      phase_ = Phase::running;
      return true;
    case Phase::running:
      return false;
    case Phase::stop:
      sendToAll(oentryDESTROY, oreasonSHUTDOWN);
      phase_ = Phase::destroy;
      return true;
    case Phase::destroy:
      phase_ = Phase::over;
      end(Ended::Why::shutdown, "", "", "all objects have stopped");
      return false;
    case Phase::over:
      return false;
  }
  return false;
}

// ---- console ----------------------------------------------------------------------------------------------------

void System::say(const std::string& object, const std::string& text) {
  printed_ += text.size() + 32;
  if (printed_ > printedPerFrame) return;
  orders_.lines.push_back({object, text});
}

void System::sayOnce(const std::string& about, const std::string& text) { sayOnce(current_, about, text); }

void System::sayOnce(const RunningObject* of, const std::string& about, const std::string& text) {
  constexpr std::ptrdiff_t most = 16;
  const std::string object = of == nullptr ? "" : of->name;
  const auto ofObject =
      std::count_if(saidOnce_.begin(), saidOnce_.end(), [&object](const auto& said) { return said.first == object; });
  if (ofObject < most && saidOnce_.insert({object, about}).second) say(object, text);
}

void System::flushLine(RunningObject& object) {
  say(object.name, object.line);
  object.line.clear();
}

void System::write(RunningObject* object, const char* text, std::size_t size) {
  if (object == nullptr) return;
  for (std::size_t i = 0; i < size; ++i) {
    if (text[i] == '\n')
      flushLine(*object);
    else if (text[i] != '\r' && text[i] != '\0')
      object->line += text[i];
    if (object->line.size() >= 4096) flushLine(*object);
  }
}

std::size_t System::readTyped(char* to, std::size_t limit) {
  if (!waitUntil([this] { return !typed_.empty(); })) return 0;
  const auto end = typed_.find('\n');
  const std::size_t size = std::min(limit, end == std::string::npos ? typed_.size() : end + 1);
  std::memcpy(to, typed_.data(), size);
  typed_.erase(0, size);
  return size;
}

// ---- frames -----------------------------------------------------------------------------------------------------

OrderFrame System::step(const SensorFrame& frame) {
  std::vector<ConsoleLine> before = std::move(orders_.lines);  // of loading
  orders_ = {};
  orders_.lines = std::move(before);
  printed_ = 0;
  sensed_ = frame;
  sensed_.joints.resize(design.joints.size());
  sensed_.sensors.resize(design.sensors.size());
  typed_ += frame.typed;
  if (typed_.size() > (1u << 20)) typed_.resize(1u << 20);
  if (!ended_) {
    services_->sense();
    pump();
  }
  if (!ended_) services_->act(orders_);
  if (!ended_ && (frame.shutdown || shutdownAsked_)) {
    if (phase_ >= Phase::init) sendToAll(oentrySTOP, oreasonSHUTDOWN);
    phase_ = Phase::stop;
    for (int i = 0; i < 3 && !ended_; ++i) pump();
    if (!ended_) end(Ended::Why::shutdown, "", "", "the robot was switched off before all objects had stopped");
  }
  if (ended_) {
    for (const auto& object : objects_)
      if (!object->line.empty()) flushLine(*object);
    services_->finish();
    orders_.ended = ended_;
  }
  OrderFrame done = std::move(orders_);
  orders_ = {};
  return done;
}

void System::shutDown() { shutdownAsked_ = true; }

void System::end(Ended::Why why, const std::string& object, const std::string& method, const std::string& what) {
  if (!ended_) ended_ = Ended{why, object, method, what};
}

}  // namespace btr::openr
