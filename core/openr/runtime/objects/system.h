#pragma once
#include <OPENR/OPENR.h>
#include <OPENR/ObjcommTypes.h>
#include <setjmp.h>
#include <ucontext.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/openr/robot_design.h"
#include "core/openr/robot_link.h"
#include "core/openr/stick_config.h"

namespace btr::openr {

class Services;

/// One message in an object's mailbox.
struct Message {
  std::uint64_t order = 0;  ///< of all messages
  Selector selector = UNDEF;
  std::shared_ptr<void> content;
};

/// A service that an object has registered, and where its messages go.
struct Service {
  std::string name;     ///< "Object.Sub.Type.S"
  OServiceEntry begin;  ///< Control or Connect
};

/// An object with its mailbox: one of the program's, on a stack of its own, or one of the robot's (`native`).
struct RunningObject {
  std::string name;
  OID oid;
  int index = 0;
  unsigned priorityClass = 8;
  std::map<Selector, void (*)(void*)> entries;
  std::vector<std::string> methods;  ///< by selector
  std::function<void(Selector, void*)> native;

  std::deque<Message> mailbox;
  std::vector<Service> subjects, observers;
  std::vector<OServiceEntry> readyEntries, notifyEntries;  ///< in the same order

  // Where its method is while it waits.
  ucontext_t context{};
  jmp_buf methodEnd{};
  char* stack = nullptr;
  bool started = false, busy = false;
  std::function<bool()> wakes;  ///< set while it waits: whether it may go on
  Message running;

  // Its console.
  FILE *in = nullptr, *out = nullptr, *err = nullptr;
  std::string line;  ///< begun

  std::string methodName(Selector selector) const;
};

/// The program of one robot: its objects, their messages, the console and the simulated time. One thread.
class System {
 public:
  System(const RobotDesign& design, std::string stick);
  ~System();
  static System& instance();

  const RobotDesign design;
  const std::string stick;
  StickConfig config;

  /// Loads what OBJECT.CFG names. What cannot be loaded is said on the console and left out.
  void load();
  /// One step: what the robot senses, then all that the objects do about it, then what the robot is to do.
  OrderFrame step(const SensorFrame& frame);
  bool ended() const { return ended_.has_value(); }

  // For the calls of objects.
  RunningObject* current() { return current_; }
  RunningObject* objectOf(const OID& oid);
  RunningObject& addNative(const std::string& name, std::function<void(Selector, void*)> handler);
  /// Into the mailbox; a message to nobody is dropped.
  void send(const OServiceEntry& to, std::shared_ptr<void> content);
  /// The method that runs waits, its object with it, until `condition` holds. At once if it holds already. False if
  /// nothing can wait here (no method runs).
  bool waitUntil(std::function<bool()> condition);
  /// Ends the method that runs, as exit() does.
  [[noreturn]] void endMethod();
  void write(RunningObject* object, const char* text, std::size_t size);
  void say(const std::string& object, const std::string& text);
  /// What the object that runs may wonder about, said once for each thing, and of a few things alone.
  void sayOnce(const std::string& about, const std::string& text);
  void sayOnce(const RunningObject* object, const std::string& about, const std::string& text);
  /// Takes a typed line (or what there is of it, if `limit` is less); waits for it.
  std::size_t readTyped(char* to, std::size_t limit);
  /// All objects stop; the robot is off.
  void shutDown();
  void end(Ended::Why why, const std::string& object, const std::string& method, const std::string& what);
  const SensorFrame& sensed() const { return sensed_; }
  std::int64_t time_us() const { return sensed_.time_us; }
  /// For programs. Time passes between frames alone, so a method that reads the clock again and again waits for it.
  std::int64_t readClock_us();
  Services& services() { return *services_; }
  OrderFrame& orders() { return orders_; }

  /// Of observers: SetBufCtrlParam.
  struct BufferControl {
    std::size_t skip = 0, min = 1, max = 1;
  };
  std::map<ObserverID, BufferControl> bufferControl;
  /// Of subjects: the observer is not told of them.
  void refuse(const SubjectID& subject, const ObserverID& observer) { refused_.insert({subject, observer}); }

  static constexpr std::size_t stackBytes = 1u << 20;

 private:
  static OID oidOf(int index);  ///< made up, the same each time
  void loadObject(const std::string& path);
  void leaveOut(const std::string& why);
  void addStack(RunningObject& object);
  static void objectMain();
  void run(RunningObject& object);
  void enter(RunningObject& object);
  void leave();
  RunningObject* next();
  void pump();
  bool quiet() const;
  bool advance();
  void connect();
  void connectObservers();
  void sendToAll(Selector selector, OReason reason);
  void flushLine(RunningObject& object);

  enum class Phase { load, init, control, connect, start, running, stop, destroy, over };
  Phase phase_ = Phase::load;
  struct Connection {
    ObserverID observer;
    OServiceEntry entry;  ///< the observer's Connect
    std::shared_ptr<OConnectMessage> message;
  };
  std::vector<Connection> connections_;  ///< of which subjects were told
  std::set<std::pair<SubjectID, ObserverID>> refused_;
  std::set<std::pair<std::string, std::string>> saidOnce_;  ///< by object
  std::vector<std::unique_ptr<RunningObject>> objects_;
  std::unique_ptr<Services> services_;
  RunningObject* current_ = nullptr;
  struct ClockReads {
    const RunningObject* by = nullptr;
    std::int64_t at_us = 0;
    int count = 0;
  } clockReads_;
  ucontext_t main_{};
  std::uint64_t order_ = 0;
  SensorFrame sensed_;
  OrderFrame orders_;
  std::string typed_;
  std::size_t printed_ = 0;
  bool shutdownAsked_ = false;
  int stopFrames_ = 0;
  std::optional<Ended> ended_;
  std::string modules_;  ///< folder of the private copies
  std::string leftOut_;  ///< why objects could not be loaded
  FILE *stdin_ = nullptr, *stdout_ = nullptr, *stderr_ = nullptr;
};

/// Whether there is a System::instance().
bool theSystemIsThere();

/// While one is there, the C library's functions are the computer's own, though a method runs: for calls that the
/// run-time answers.
class OwnAccess {
 public:
  OwnAccess() { ++depth_; }
  ~OwnAccess() { --depth_; }
  OwnAccess(const OwnAccess&) = delete;
  OwnAccess& operator=(const OwnAccess&) = delete;
  static bool any() { return depth_ > 0; }

 private:
  static inline int depth_ = 0;
};

}  // namespace btr::openr
