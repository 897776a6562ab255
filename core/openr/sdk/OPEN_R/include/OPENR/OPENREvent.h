#ifndef BTR_OPENR_OPENREVENT_H
#define BTR_OPENR_OPENREVENT_H

#include <OPENR/OPENR.h>
#include <OPENR/OPENRMessages.h>

/// Why Init, Start, Stop or Destroy is called.
class OSystemEvent {
 public:
  OSystemEvent(OReason reason, void* param, size_t paramSize) : reason_(reason), param_(param), paramSize_(paramSize) {}
  ~OSystemEvent() {}

  OReason Reason() const { return reason_; }
  const void* Param() const { return param_; }
  size_t ParamSize() const { return paramSize_; }

 private:
  OReason reason_;
  void* param_;
  size_t paramSize_;
};

#endif
