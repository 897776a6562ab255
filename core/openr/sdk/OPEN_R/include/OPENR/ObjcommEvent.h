// What the methods of a stub are told.
#ifndef BTR_OPENR_OBJCOMMEVENT_H
#define BTR_OPENR_OBJCOMMEVENT_H

#include <OPENR/ObjcommTypes.h>

class OConnectEvent {
 public:
  OConnectEvent(int index, char* name, OConnectCmd command) : index_(index), name_(name), command_(command) {}
  ~OConnectEvent() {}
  int ObsIndex() const { return index_; }
  const char* SubName() const { return name_; }
  bool IsConnect() const { return command_ == objcommCONNECT; }
  bool IsDisconnect() const { return command_ == objcommDISCONNECT; }

 private:
  int index_;
  const char* name_;
  OConnectCmd command_;
};

class OControlEvent {
 public:
  OControlEvent(int index, char* name, ObjcommCommand command) : index_(index), name_(name), command_(command) {}
  OControlEvent(int index, ObserverID id, char* name, ObjcommCommand command)
      : index_(index), id_(id), name_(name), command_(command) {}
  ~OControlEvent() {}
  int SbjIndex() const { return index_; }
  const char* SubName() const { return name_; }
  bool IsAddObserver() const { return command_ == objcommADD_OBSERVER; }
  bool IsRemoveObserver() const { return command_ == objcommREMOVE_OBSERVER; }
  const ObserverID& SenderID() const { return id_; }

 private:
  int index_;
  ObserverID id_;
  const char* name_;
  ObjcommCommand command_;
};

class OReadyEvent {
 public:
  OReadyEvent(int index, ObserverID id, ObjcommCommand command) : index_(index), id_(id), command_(command) {}
  ~OReadyEvent() {}
  int SbjIndex() const { return index_; }
  const ObserverID& SenderID() const { return id_; }
  bool IsAssert() const { return command_ == objcommASSERT_READY; }
  bool IsDeassert() const { return command_ == objcommDEASSERT_READY; }

 private:
  int index_;
  ObserverID id_;
  ObjcommCommand command_;
};

/// Its data stay until the observer's next AssertReady or DeassertReady to the sender.
class ONotifyEvent {
 public:
  ONotifyEvent() : index_(0), numData_(0), numNotify_(0) {
    for (int i = 0; i < objcommMAX_DATA; ++i) {
      regions_[i] = 0;
      data_[i] = 0;
    }
  }
  ~ONotifyEvent() {}
  void SetIndex(int i) { index_ = i; }
  void SetSubjectInfo(const OSubjectInfo& s) { sender_ = OSubjectInfo(s.id); }
  void SetNumOfData(int n) { numData_ = n; }
  void SetNumOfNotify(int n) { numNotify_ = n; }
  void SetData(int index, RCRegion* r) {
    if (index < 0 || index >= objcommMAX_DATA) return;
    regions_[index] = r;
    data_[index] = r == 0 ? 0 : r->Base();
  }
  int ObsIndex() const { return index_; }
  const OSubjectInfo& SenderID() const { return sender_; }
  int NumOfData() const { return numData_; }
  int NumOfNotify() const { return numNotify_; }
  const void* Data(int i) const { return i < 0 || i >= numData_ ? 0 : data_[i]; }
  const void** Data() const { return const_cast<const void**>(data_); }
  RCRegion* RCData(int i) const { return i < 0 || i >= numData_ ? 0 : regions_[i]; }

 private:
  int index_;
  OSubjectInfo sender_;
  int numData_, numNotify_;
  RCRegion* regions_[objcommMAX_DATA];
  const void* data_[objcommMAX_DATA];
};

#endif
