#include "core/openr/runtime/system.h"

#include <OPENR/OPENRMessages.h>
#include <ObjectEntryTable.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <iostream>
#include <sstream>

#include "core/openr/runtime/console.h"
#include "core/openr/runtime/faults.h"
#include "core/openr/runtime/gunzip.h"
#include "core/openr/runtime/services.h"
#include "core/spec/error.h"

namespace btr::openr {
namespace {

System* theSystem = nullptr;

/// So many messages are handled in one frame of 8 ms; the others wait for the next, so that objects that answer each
/// other without end let time pass.
constexpr int messagesPerFrame = 2000;
/// More than this is not printed in one frame.
constexpr std::size_t printedPerFrame = 1u << 20;

void* oidAddress(int index) { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(0x1000) * (index + 1)); }

/// A handle on a copy of the module that no other robot or object shares; nullptr with `error` set.
void* openCopy(const std::vector<char>& bytes, std::string& error) {
  const int file = memfd_create("openr-module", MFD_CLOEXEC);
  if (file < 0 || ::write(file, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
    error = "there is no memory for it";
    if (file >= 0) close(file);
    return nullptr;
  }
  void* handle = dlopen(("/proc/self/fd/" + std::to_string(file)).c_str(), RTLD_NOW | RTLD_LOCAL);
  // It stays open: the loader would take another file of this number for the same module.
  if (handle == nullptr) error = dlerror();
  return handle;
}

std::string nameOf(void* handle, const std::string& path) {
  if (const auto* name = static_cast<const char*>(dlsym(handle, "btr_openr_object"))) return name;
  if (const auto* ocf = static_cast<const char*>(dlsym(handle, "btr_openr_ocf"))) {
    std::istringstream words(ocf);
    std::string first, name;
    if (words >> first >> name) return name;
  }
  const auto slash = path.rfind('/');
  return path.substr(slash == std::string::npos ? 0 : slash + 1);
}

/// The high 4 bits of the priority in an .ocf; objects of a lower class wait for those of a higher.
unsigned priorityClassOf(void* handle) {
  const auto* ocf = static_cast<const char*>(dlsym(handle, "btr_openr_ocf"));
  if (ocf == nullptr) return 8;
  std::istringstream words(ocf);
  std::string first, name;
  unsigned stack = 0, heap = 0, priority = 128;
  words >> first >> name >> stack >> heap >> priority;
  return words ? (priority >> 4) & 15 : 8;
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

System& System::instance() { return *theSystem; }

bool theSystemIsThere() { return theSystem != nullptr; }

void System::load() {
  config = stickConfig(stick, design.name);
  for (const std::string& path : config.objects) {
    if (ended_) return;
    loadObject(path);
  }
}

void System::loadObject(const std::string& path) {
  const std::string file = onStick(stick, path);
  std::vector<char> bytes;
  if (file.empty() || !unpackedFile(file, bytes)) {
    say("", path + " is not on the stick: started without it");
    return;
  }
  auto added = std::make_unique<RunningObject>();
  RunningObject& object = *added;
  object.index = static_cast<int>(objects_.size());
  object.oid = OID(oidAddress(object.index));
  object.name = path.substr(path.rfind('/') + 1);
  objects_.push_back(std::move(added));
  addStack(object);

  FaultState& fault = faultState();
  fault.object = &object;
  fault.selector = UNDEF;
  void* handle = nullptr;
  std::string error;
  if (sigsetjmp(fault.home, 1) == 0) {
    current_ = &object;
    enter(object);
    ++fault.serial;
    fault.inMethod = true;
    handle = openCopy(bytes, error);
    fault.inMethod = false;
    leave();
  } else {
    fault.inMethod = false;
    leave();
    end(Ended::Why::crash, object.name, object.methodName(UNDEF), fault.what);
    return;
  }
  const auto* table = handle == nullptr ? nullptr : static_cast<const ObjectEntry*>(dlsym(handle, "ObjectEntryTable"));
  if (table == nullptr) {
    say("", path + " is no module that `btr openr build` has made for this computer (" +
                (error.empty() ? "it has no ObjectEntryTable" : error) + "): started without it");
    object.entries.clear();
    object.name.clear();
    return;
  }
  const std::string fileName = object.name;
  object.name = nameOf(handle, path);
  for (ConsoleLine& line : orders_.lines)  // of its constructors
    if (line.object == fileName) line.object = object.name;
  object.priorityClass = priorityClassOf(handle);
  for (; table->selector != UNDEF; ++table)
    object.entries[table->selector] = reinterpret_cast<void (*)(void*)>(table->entry);
  if (const auto* methods = static_cast<const char* const*>(dlsym(handle, "btr_openr_methods")))
    for (; *methods != nullptr; ++methods) object.methods.emplace_back(*methods);
}

void System::addStack(RunningObject& object) {
  const std::size_t guard = 65536;
  auto* memory = static_cast<char*>(
      mmap(nullptr, stackBytes + guard, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0));
  if (memory == MAP_FAILED) throw InputError("there is no memory for the stack of another object");
  object.stack = memory + guard;
  mprotect(object.stack, stackBytes, PROT_READ | PROT_WRITE);
  openConsole(object);
}

RunningObject& System::addNative(const std::string& name, std::function<void(Selector, void*)> handler) {
  auto added = std::make_unique<RunningObject>();
  added->index = static_cast<int>(objects_.size());
  added->oid = OID(oidAddress(added->index));
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

// ---- connections ------------------------------------------------------------------------------------------------

void System::connect() {
  const auto find = [this](const std::string& name, bool subject, OServiceEntry& begin, OServiceEntry& data) {
    for (const auto& object : objects_) {
      const auto& services = subject ? object->subjects : object->observers;
      const auto& entries = subject ? object->readyEntries : object->notifyEntries;
      for (std::size_t i = 0; i < services.size(); ++i) {
        if (services[i].name != name) continue;
        begin = services[i].begin;
        if (i < entries.size()) data = entries[i];
        return true;
      }
    }
    return false;
  };
  const auto part = [](const std::string& name, int wanted) {
    std::istringstream in(name);
    std::string found;
    for (int i = 0; i <= wanted; ++i)
      if (!std::getline(in, found, '.')) return std::string();
    return found;
  };
  for (const auto& [subject, observer] : config.connections) {
    OServiceEntry control, ready, connectTo, notify;
    const bool hasSubject = find(subject, true, control, ready), hasObserver = find(observer, false, connectTo, notify);
    if (!hasSubject || !hasObserver) {
      say("", "CONNECT.CFG: nobody here has " + (hasSubject ? observer : subject) + ": not connected");
      continue;
    }
    if (part(subject, 2) != part(observer, 2)) {
      say("", "CONNECT.CFG: " + subject + " and " + observer + " have different types: not connected");
      continue;
    }
    auto forSubject = std::make_shared<OControlMessage>();
    forSubject->command = objcommADD_OBSERVER;
    forSubject->observer = notify;
    std::snprintf(forSubject->name, sizeof(forSubject->name), "%s", observer.c_str());
    send(control, forSubject);
    auto forObserver = std::make_shared<OConnectMessage>();
    forObserver->command = objcommCONNECT;
    forObserver->subject = ready;
    std::snprintf(forObserver->name, sizeof(forObserver->name), "%s", subject.c_str());
    send(connectTo, forObserver);
  }
}

// ---- console ----------------------------------------------------------------------------------------------------

void System::say(const std::string& object, const std::string& text) {
  printed_ += text.size() + 32;
  if (printed_ > printedPerFrame) return;
  orders_.lines.push_back({object, text});
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
