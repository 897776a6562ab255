#ifndef BTR_OPENR_OOBSERVER_H
#define BTR_OPENR_OOBSERVER_H

#include <OPENR/OPENR.h>
#include <OPENR/ObjcommEvent.h>
#include <OPENR/ObjcommTypes.h>
#include <OPENR/RCRegion.h>

#include <iostream>
#include <list>

using std::cout;
using std::endl;
using std::list;

/// Receives the data of the subjects that it is connected to, and tells them when it takes more.
class OObserver {
 public:
  OObserver(void);
  virtual ~OObserver();

  OStatus SetNotifyEntry(const OServiceEntry& entry);
  void SetSkip(size_t d);
  /// Leaves out `skip` units between two, is sent to from `min` units on, and has at most `max` kept while not ready.
  void SetBufCtrlParam(size_t skip, size_t min, size_t max);

  OStatus ConnectHandler(const OConnectMessage& msg, OStatus s = oSUCCESS);
  OStatus NotifyHandler(const ONotifyMessage& msg, ONotifyEvent* pEvent);
  OStatus ConnectHandler(OConnectMessage* msg) { return ConnectHandler(*msg); }
  OStatus NotifyHandler(ONotifyMessage* msg, ONotifyEvent* pEvent) { return NotifyHandler(*msg, pEvent); }

  OStatus AssertReady(void);
  OStatus DeassertReady(void);
  OStatus AssertReady(const SubjectID& id);
  OStatus DeassertReady(const SubjectID& id);
  OStatus AssertReady(const OSubjectInfo& info) { return AssertReady(info.id); }
  OStatus DeassertReady(const OSubjectInfo& info) { return DeassertReady(info.id); }

  SubjectConstIterator begin(void) const { return subjects_.begin(); }
  SubjectConstIterator end(void) const { return subjects_.end(); }
  SubjectID FindSender(RCRegion* region) const;
  int NumberOfSubjects(void) const { return static_cast<int>(subjects_.size()); }
  const ObserverID& GetObserverID(void) const { return id_; }
  const ObserverID& GetID(void) const { return id_; }
  void Dump(unsigned int* address, size_t size);

  size_t Skip() const { return skip_; }
  size_t Min() const { return min_; }
  size_t Max() const { return max_; }

 private:
  OObserver(const OObserver&);
  OObserver& operator=(const OObserver&);
  OStatus tell(OSubjectInfo& subject, ObjcommCommand command);

  ObserverID id_;
  size_t skip_, min_, max_;
  std::list<OSubjectInfo> subjects_;
};

#endif
