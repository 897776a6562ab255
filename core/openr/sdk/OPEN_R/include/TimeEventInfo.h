// Timers: a message to an object after some time, once or again and again. They come with the frame of 8 ms in which
// they are due, in the order in which they are.
#ifndef BTR_OPENR_TIMEEVENTINFO_H
#define BTR_OPENR_TIMEEVENTINFO_H

#include <Time_a.h>

struct TimeEventInfo {
  enum EventType { Periodic, NonPeriodic };
  enum EventAttr { ExceedStartImmediate = 0x00000000, ExceedStartError = 0x00010000 };

  RelativeTime relativeTime;  ///< until the first
  RelativeTime periodicTime;  ///< between two
};

struct TimeEventInfoWithRelativeTime : public TimeEventInfo {
  bool isRelativeTime;
  EventType eventType;
  longword eventAttr;

  /// Periodic if `between` is not 0.
  TimeEventInfoWithRelativeTime(RelativeTime first, RelativeTime between = RelativeTime(),
                                longword attr = ExceedStartImmediate) {
    Set(first, between, attr);
  }
  /// Both times are `time`.
  TimeEventInfoWithRelativeTime(EventType type, RelativeTime time) { Set(type, time); }
  void Set(RelativeTime first, RelativeTime between = RelativeTime(), longword attr = ExceedStartImmediate) {
    isRelativeTime = true;
    eventType = between.sec == 0 && between.msec == 0 ? NonPeriodic : Periodic;
    eventAttr = attr;
    relativeTime = first;
    periodicTime = between;
  }
  void Set(EventType type, RelativeTime time) {
    Set(time, type == Periodic ? time : RelativeTime());
    eventType = type;
  }
};

/// Which timer.
class EventID {
 public:
  EventID() : number_(0) {}
  explicit EventID(longword number) : number_(number) {}
  longword GetNumber() const { return number_; }

 private:
  longword number_;
};

/// `selector` of `object` is called with a copy of the `size` bytes of `message`. sINVALID_ARG for a periodic one
/// without time between two.
sError SetTimeEvent(const TimeEventInfoWithRelativeTime* info, OID object, Selector selector, void* message,
                    size_t size, EventID* id);
/// sNOT_FOUND if it is over or was never set.
sError CancelTimeEvent(EventID id);

#endif
