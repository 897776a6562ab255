// An observer: what it holds of each of its subjects goes back with its next assert.
#include <OPENR/OObserver.h>

#include <algorithm>
#include <cstdio>

#include "core/openr/runtime/objects/objcomm.h"
#include "core/openr/runtime/objects/system.h"

using btr::openr::System;

namespace {

/// A message that lets go of its regions if nobody has taken them.
struct AssertMessage : OReadyMessage {
  std::vector<RCRegion*> back;
  ~AssertMessage() {
    for (int i = 0; i < numRegions; ++i) regions[i]->RemoveReference();
  }
};

}  // namespace

namespace btr::openr {

void sendReady(const SubjectID& to, const ObserverID& from, ObjcommCommand command, std::vector<RCRegion*> back) {
  auto message = std::make_shared<AssertMessage>();
  message->command = command;
  message->observer = from;
  message->back = std::move(back);
  message->numRegions = static_cast<int>(message->back.size());
  message->regions = message->back.data();
  System::instance().send(to, message);
}

}  // namespace btr::openr

OObserver::OObserver() : skip_(0), min_(1), max_(1) {}

OObserver::~OObserver() {
  for (OSubjectInfo& subject : subjects_)
    for (RCRegion* region : subject.held) region->RemoveReference();
}

OStatus OObserver::SetNotifyEntry(const OServiceEntry& entry) {
  id_ = entry;
  auto* object = System::instance().objectOf(entry.oid);
  if (object == nullptr) return oINVALID_OID;
  object->notifyEntries.push_back(entry);
  System::instance().bufferControl[id_] = {skip_, min_, max_};
  return oSUCCESS;
}

void OObserver::SetSkip(std::size_t d) { SetBufCtrlParam(d, min_, max_); }

void OObserver::SetBufCtrlParam(std::size_t skip, std::size_t min, std::size_t max) {
  skip_ = skip;
  min_ = min;
  max_ = max;
  System::instance().bufferControl[id_] = {skip, min, max};
}

OStatus OObserver::ConnectHandler(const OConnectMessage& msg, OStatus s) {
  if (msg.command == objcommDISCONNECT) {
    subjects_.remove_if([&](const OSubjectInfo& subject) { return subject.id == msg.subject; });
    return oSUCCESS;
  }
  if (s != oSUCCESS) {
    System::instance().say("", std::string("CONNECT.CFG: an observer refuses ") + msg.name + " (status " +
                                   std::to_string(s) + "): not connected");
    return oREFUSED;
  }
  subjects_.push_back(OSubjectInfo(msg.subject));
  return oSUCCESS;
}

OStatus OObserver::NotifyHandler(const ONotifyMessage& msg, ONotifyEvent* pEvent) {
  auto& message = const_cast<ONotifyMessage&>(msg);
  const int count = message.numData;
  message.numData = 0;  // they are the observer's now
  pEvent->SetSubjectInfo(OSubjectInfo(msg.subject));
  pEvent->SetNumOfData(count);
  pEvent->SetNumOfNotify(msg.numNotify);
  OSubjectInfo* sender = nullptr;
  for (OSubjectInfo& subject : subjects_)
    if (subject.id == msg.subject) sender = &subject;
  for (int i = 0; i < count; ++i) {
    pEvent->SetData(i, msg.data[i]);
    if (sender != nullptr)
      sender->held.push_back(msg.data[i]);
    else
      msg.data[i]->RemoveReference();
  }
  if (sender == nullptr) pEvent->SetNumOfData(0);
  return sender == nullptr ? oNOT_FOUND : oSUCCESS;
}

OStatus OObserver::tell(OSubjectInfo& subject, ObjcommCommand command) {
  std::vector<RCRegion*> back;
  back.swap(subject.held);
  btr::openr::sendReady(subject.id, id_, command, std::move(back));
  return oSUCCESS;
}

OStatus OObserver::AssertReady() {
  for (OSubjectInfo& subject : subjects_) tell(subject, objcommASSERT_READY);
  return oSUCCESS;
}

OStatus OObserver::DeassertReady() {
  for (OSubjectInfo& subject : subjects_) tell(subject, objcommDEASSERT_READY);
  return oSUCCESS;
}

OStatus OObserver::AssertReady(const SubjectID& id) {
  for (OSubjectInfo& subject : subjects_)
    if (subject.id == id) return tell(subject, objcommASSERT_READY);
  return oNOT_FOUND;
}

OStatus OObserver::DeassertReady(const SubjectID& id) {
  for (OSubjectInfo& subject : subjects_)
    if (subject.id == id) return tell(subject, objcommDEASSERT_READY);
  return oNOT_FOUND;
}

SubjectID OObserver::FindSender(RCRegion* region) const {
  for (const OSubjectInfo& subject : subjects_)
    if (std::find(subject.held.begin(), subject.held.end(), region) != subject.held.end()) return subject.id;
  return SubjectID();
}

void OObserver::Dump(unsigned int* address, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) std::printf("%08x%c", address[i], i % 8 == 7 ? '\n' : ' ');
  std::printf("\n");
}
