#ifndef BTR_OPENR_OSUBJECT_H
#define BTR_OPENR_OSUBJECT_H

#include <OPENR/OPENR.h>
#include <OPENR/OShmPtr.h>
#include <OPENR/ObjcommEvent.h>
#include <OPENR/ObjcommTypes.h>
#include <OPENR/RCRegion.h>

#include <list>

using std::list;

/// Sends data to the observers that are connected to it: to each when that one is ready, else what its buffer keeps.
class OSubject {
 public:
  OSubject(void);
  virtual ~OSubject();

  OStatus SetReadyEntry(const OServiceEntry& readyEntry);
  const SubjectID& GetID(void) const { return id_; }

  OStatus SetBufferSize(size_t size);
  size_t GetBufferSize(void) const { return bufferSize_; }
  OStatus SetNotifyUnitSize(size_t size);
  size_t GetNotifyUnitSize(void) const { return unitSize_; }

  OStatus SetData(const OObserverInfo& info, RCRegion* r);
  OStatus SetData(const ObserverID& id, RCRegion* r);
  OStatus SetData(RCRegion* r);
  OStatus SetData(const OObserverInfo& info, const OShmPtrBase& p);
  OStatus SetData(const ObserverID& id, const OShmPtrBase& p);
  OStatus SetData(const OShmPtrBase& p);
  OStatus SetData(const OObserverInfo& info, const void* buf, size_t size);
  OStatus SetData(const ObserverID& id, const void* buf, size_t size);
  OStatus SetData(const void* buf, size_t size);
  OStatus SetData(const OObserverInfo& info, MemoryRegionID mid, u_int offset);
  OStatus SetData(const ObserverID& id, MemoryRegionID memID, u_int offset);
  OStatus SetData(MemoryRegionID memID, size_t size);
  OStatus SetData(const OObserverInfo& info, const OMemoryLocator& l);
  OStatus SetData(const ObserverID& id, const OMemoryLocator& l);
  OStatus SetData(const OMemoryLocator& l);

  OStatus NotifyObserver(const OObserverInfo& observer);
  OStatus NotifyObserver(const ObserverID& observer);
  OStatus NotifyObservers(void);

  size_t RemainBuffer(const OObserverInfo& observer) const;
  size_t RemainBuffer(const ObserverID& id) const;
  size_t RemainBuffer(void) const;
  OStatus ClearBuffer(const OObserverInfo& info);
  OStatus ClearBuffer(const ObserverID& id);
  OStatus ClearBuffer();

  OStatus ControlHandler(const OControlMessage& msg, OStatus status = oSUCCESS);
  OStatus ReadyHandler(const OReadyMessage& msg);
  OStatus ControlHandler(OControlMessage* msg) { return ControlHandler(*msg); }
  OStatus ReadyHandler(OReadyMessage* msg) { return ReadyHandler(*msg); }

  int NumberOfObservers(void) const { return static_cast<int>(observers_.size()); }
  ObserverConstIterator begin(void) const { return observers_.begin(); }
  ObserverConstIterator end(void) const { return observers_.end(); }
  ObserverConstIterator FindObserver(const ObserverID& id) const;

  int ReadyStatus(const ObserverID& id) const;
  int ReadyStatus(const OObserverInfo& info) const { return ReadyStatus(info.id); }
  int IsAllReady(void) const;
  int IsAnyReady(void) const;
  int IsReady(void) const { return IsAnyReady(); }
  int IsReady(const ObserverID& id) const { return ReadyStatus(id) == 1 ? 1 : 0; }
  int IsReady(const OObserverInfo& info) const { return IsReady(info.id); }

  int NumberOfReference(const OMemoryLocator& locator) const;
  int Lock(RCRegion* r);
  int Unlock(RCRegion* r);

 private:
  OSubject(const OSubject&);
  OSubject& operator=(const OSubject&);
  OObserverInfo* find(const ObserverID& id);
  const OObserverInfo* find(const ObserverID& id) const;

  SubjectID id_;
  size_t bufferSize_, unitSize_;
  std::list<OObserverInfo> observers_;
};

#endif
