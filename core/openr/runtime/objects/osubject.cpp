// A subject: for each of its observers a ready state and a buffer.
#include <OPENR/OSubject.h>

#include <algorithm>
#include <cstring>
#include <deque>

#include "core/openr/runtime/objects/regions.h"
#include "core/openr/runtime/objects/system.h"

using btr::openr::System;

/// What waits for one observer: data set since the last Notify, then whole units.
struct OPairBuffer {
  std::deque<RCRegion*> pending;
  std::deque<std::vector<RCRegion*>> units;
  std::size_t leaveOut = 0;  ///< units until one is taken

  std::size_t entries() const {
    std::size_t count = pending.size();
    for (const auto& unit : units) count += unit.size();
    return count;
  }
  void dropUnit() {
    for (RCRegion* region : units.front()) region->RemoveReference();
    units.pop_front();
  }
  void dropOldest() {
    if (!units.empty()) return dropUnit();
    pending.front()->RemoveReference();
    pending.pop_front();
  }
  void dropUnits() {
    while (!units.empty()) dropUnit();
  }
  void dropAll() {
    while (entries() > 0) dropOldest();
  }
};

namespace {

/// A message that lets go of its regions if nobody has taken them.
struct NoticeMessage : ONotifyMessage {
  NoticeMessage() { numData = numNotify = 0; }
  ~NoticeMessage() {
    for (int i = 0; i < numData; ++i) data[i]->RemoveReference();
  }
};

System::BufferControl controlOf(const ObserverID& id) { return System::instance().bufferControl[id]; }

void sendUnits(const SubjectID& from, OObserverInfo& to) {
  auto message = std::make_shared<NoticeMessage>();
  message->subject = from;
  auto& units = to.buffer->units;
  while (!units.empty() && message->numData + static_cast<int>(units.front().size()) <= objcommMAX_DATA) {
    for (RCRegion* region : units.front()) message->data[message->numData++] = region;
    ++message->numNotify;
    units.pop_front();
  }
  to.ready = 0;
  System::instance().send(to.id, message);
}

/// Data set so far become units; they go, wait or are lost as the observer's state says.
void notify(const SubjectID& from, OObserverInfo& to, std::size_t unitSize) {
  OPairBuffer& buffer = *to.buffer;
  const auto control = controlOf(to.id);
  while (buffer.pending.size() >= unitSize) {
    std::vector<RCRegion*> unit(buffer.pending.begin(), buffer.pending.begin() + static_cast<std::ptrdiff_t>(unitSize));
    buffer.pending.erase(buffer.pending.begin(), buffer.pending.begin() + static_cast<std::ptrdiff_t>(unitSize));
    buffer.units.push_back(std::move(unit));
    if (buffer.leaveOut == 0) {
      buffer.leaveOut = control.skip;
      continue;
    }
    --buffer.leaveOut;
    for (RCRegion* region : buffer.units.back()) region->RemoveReference();
    buffer.units.pop_back();
  }
  if (to.ready < 0) {
    buffer.dropUnits();
  } else if (to.ready == 1) {
    if (!buffer.units.empty() && buffer.units.size() >= control.min) sendUnits(from, to);
  } else {
    while (buffer.units.size() > std::max<std::size_t>(control.max, 1)) buffer.dropUnit();
  }
}

void setData(OObserverInfo& to, RCRegion* region, std::size_t bufferSize) {
  OPairBuffer& buffer = *to.buffer;
  region->AddReference();
  buffer.pending.push_back(region);
  while (buffer.entries() > bufferSize) buffer.dropOldest();
}

RCRegion* copyOf(const void* bytes, std::size_t size) {
  auto* region = new RCRegion(size);
  if (size > 0) std::memcpy(region->Base(), bytes, size);
  return region;
}

}  // namespace

OSubject::OSubject() : bufferSize_(14), unitSize_(1) {}

OSubject::~OSubject() {
  for (OObserverInfo& info : observers_) {
    info.buffer->dropAll();
    delete info.buffer;
  }
}

OStatus OSubject::SetReadyEntry(const OServiceEntry& readyEntry) {
  id_ = readyEntry;
  auto* object = System::instance().objectOf(readyEntry.oid);
  if (object == nullptr) return oINVALID_OID;
  object->readyEntries.push_back(readyEntry);
  return oSUCCESS;
}

OStatus OSubject::SetBufferSize(std::size_t size) {
  if (size == 0) return oINVALID_ARG;
  bufferSize_ = size;
  return oSUCCESS;
}

OStatus OSubject::SetNotifyUnitSize(std::size_t size) {
  if (size == 0 || size > static_cast<std::size_t>(objcommMAX_DATA)) return oINVALID_ARG;
  unitSize_ = size;
  return oSUCCESS;
}

OObserverInfo* OSubject::find(const ObserverID& id) {
  for (OObserverInfo& info : observers_)
    if (info.id == id) return &info;
  return nullptr;
}

const OObserverInfo* OSubject::find(const ObserverID& id) const {
  for (const OObserverInfo& info : observers_)
    if (info.id == id) return &info;
  return nullptr;
}

ObserverConstIterator OSubject::FindObserver(const ObserverID& id) const {
  return std::find_if(observers_.begin(), observers_.end(), [&](const OObserverInfo& info) { return info.id == id; });
}

OStatus OSubject::SetData(const ObserverID& id, RCRegion* r) {
  if (r == nullptr) return oINVALID_ARG;
  OObserverInfo* info = find(id);
  if (info == nullptr) return oNOT_FOUND;
  setData(*info, r, bufferSize_);
  return oSUCCESS;
}

OStatus OSubject::SetData(RCRegion* r) {
  if (r == nullptr) return oINVALID_ARG;
  for (OObserverInfo& info : observers_) setData(info, r, bufferSize_);
  return oSUCCESS;
}

OStatus OSubject::SetData(const ObserverID& id, const void* buf, std::size_t size) {
  if (buf == nullptr && size > 0) return oINVALID_ARG;
  RCRegion* region = copyOf(buf, size);
  const OStatus status = SetData(id, region);
  region->RemoveReference();
  return status;
}

OStatus OSubject::SetData(const void* buf, std::size_t size) {
  if (buf == nullptr && size > 0) return oINVALID_ARG;
  RCRegion* region = copyOf(buf, size);
  const OStatus status = SetData(region);
  region->RemoveReference();
  return status;
}

OStatus OSubject::SetData(const ObserverID& id, MemoryRegionID memID, u_int offset) {
  if (btr::openr::regionMemory(memID).address == nullptr) return oINVALID_ARG;
  auto* region = new RCRegion(memID, offset);
  const OStatus status = SetData(id, region);
  region->RemoveReference();
  return status;
}

OStatus OSubject::SetData(MemoryRegionID memID, std::size_t size) {
  if (btr::openr::regionMemory(memID).address == nullptr) return oINVALID_ARG;
  auto* region = new RCRegion(memID, 0, nullptr, size);
  const OStatus status = SetData(region);
  region->RemoveReference();
  return status;
}

OStatus OSubject::SetData(const OObserverInfo& info, RCRegion* r) { return SetData(info.id, r); }
OStatus OSubject::SetData(const OObserverInfo& info, const OShmPtrBase& p) { return SetData(info.id, p.RCRPtr()); }
OStatus OSubject::SetData(const ObserverID& id, const OShmPtrBase& p) { return SetData(id, p.RCRPtr()); }
OStatus OSubject::SetData(const OShmPtrBase& p) { return SetData(p.RCRPtr()); }
OStatus OSubject::SetData(const OObserverInfo& info, const void* buf, std::size_t size) {
  return SetData(info.id, buf, size);
}
OStatus OSubject::SetData(const OObserverInfo& info, MemoryRegionID mid, u_int offset) {
  return SetData(info.id, mid, offset);
}
OStatus OSubject::SetData(const OObserverInfo& info, const OMemoryLocator& l) {
  return SetData(info.id, l.mid, l.offset);
}
OStatus OSubject::SetData(const ObserverID& id, const OMemoryLocator& l) { return SetData(id, l.mid, l.offset); }
OStatus OSubject::SetData(const OMemoryLocator& l) { return SetData(l.mid, btr::openr::regionMemory(l.mid).size); }

OStatus OSubject::NotifyObserver(const OObserverInfo& observer) { return NotifyObserver(observer.id); }

OStatus OSubject::NotifyObserver(const ObserverID& observer) {
  OObserverInfo* info = find(observer);
  if (info == nullptr) return oNOT_FOUND;
  notify(id_, *info, unitSize_);
  return oSUCCESS;
}

OStatus OSubject::NotifyObservers() {
  for (OObserverInfo& info : observers_) notify(id_, info, unitSize_);
  return oSUCCESS;
}

std::size_t OSubject::RemainBuffer(const ObserverID& id) const {
  const OObserverInfo* info = find(id);
  if (info == nullptr) return 0;
  const std::size_t used = info->buffer->entries();
  return used < bufferSize_ ? bufferSize_ - used : 0;
}

std::size_t OSubject::RemainBuffer(const OObserverInfo& observer) const { return RemainBuffer(observer.id); }

std::size_t OSubject::RemainBuffer() const {
  std::size_t least = bufferSize_;
  for (const OObserverInfo& info : observers_) least = std::min(least, RemainBuffer(info.id));
  return least;
}

OStatus OSubject::ClearBuffer(const OObserverInfo& info) { return ClearBuffer(info.id); }

OStatus OSubject::ClearBuffer(const ObserverID& id) {
  OObserverInfo* info = find(id);
  if (info == nullptr) return oNOT_FOUND;
  info->buffer->dropAll();
  return oSUCCESS;
}

OStatus OSubject::ClearBuffer() {
  for (OObserverInfo& info : observers_) info.buffer->dropAll();
  return oSUCCESS;
}

OStatus OSubject::ControlHandler(const OControlMessage& msg, OStatus status) {
  if (msg.command == objcommREMOVE_OBSERVER) {
    OObserverInfo* info = find(msg.observer);
    if (info == nullptr) return oNOT_FOUND;
    info->buffer->dropAll();
    delete info->buffer;
    observers_.remove_if([&](const OObserverInfo& other) { return other.id == msg.observer; });
    return oSUCCESS;
  }
  if (status != oSUCCESS) {
    System::instance().say("", std::string("CONNECT.CFG: a subject refuses ") + msg.name + " (status " +
                                   std::to_string(status) + "): not connected");
    System::instance().refuse(id_, msg.observer);
    return oREFUSED;
  }
  if (find(msg.observer) != nullptr) return oALREADY_EXIST;
  OObserverInfo info(msg.observer);
  info.buffer = new OPairBuffer;
  observers_.push_back(info);
  return oSUCCESS;
}

OStatus OSubject::ReadyHandler(const OReadyMessage& msg) {
  OObserverInfo* info = find(msg.observer);
  if (info == nullptr) return oNOT_FOUND;
  // What came back was the message's; it is let go before the user's method looks for free regions.
  auto& message = const_cast<OReadyMessage&>(msg);
  const int count = message.numRegions;
  message.numRegions = 0;
  for (int i = 0; i < count; ++i) message.regions[i]->RemoveReference();
  if (msg.command == objcommDEASSERT_READY) {
    info->ready = -1;
    info->buffer->dropUnits();
    return oSUCCESS;
  }
  info->ready = 1;
  const auto control = controlOf(info->id);
  if (!info->buffer->units.empty() && info->buffer->units.size() >= control.min) sendUnits(id_, *info);
  return oSUCCESS;
}

int OSubject::ReadyStatus(const ObserverID& id) const {
  const OObserverInfo* info = find(id);
  return info == nullptr ? 0 : info->ready;
}

int OSubject::IsAllReady() const {
  bool one = false;
  for (const OObserverInfo& info : observers_) {
    if (info.ready == 0) return 0;
    one = one || info.ready == 1;
  }
  return one ? 1 : 0;
}

int OSubject::IsAnyReady() const {
  return std::any_of(observers_.begin(), observers_.end(), [](const OObserverInfo& info) { return info.ready == 1; })
             ? 1
             : 0;
}

int OSubject::NumberOfReference(const OMemoryLocator& locator) const {
  int count = 0;
  for (const OObserverInfo& info : observers_)
    for (const RCRegion* region : info.buffer->pending) count += region->MemID() == locator.mid ? 1 : 0;
  return count;
}

int OSubject::Lock(RCRegion* r) {
  r->AddReference();
  return r->NumberOfReference();
}

int OSubject::Unlock(RCRegion* r) {
  const int left = r->NumberOfReference() - 1;
  r->RemoveReference();
  return left;
}
