// What subjects and observers know of each other.
#ifndef BTR_OPENR_OBJCOMMTYPES_H
#define BTR_OPENR_OBJCOMMTYPES_H

#include <OPENR/OMemoryLocator.h>
#include <OPENR/OPENR.h>
#include <OPENR/RCRegion.h>

#include <list>
#include <vector>

using std::list;

const OConnectCmd objcommCONNECT = oconnectcmdCONNECT;
const OConnectCmd objcommDISCONNECT = oconnectcmdDISCONNECT;
typedef longword ObjcommCommand;
const ObjcommCommand objcommADD_OBSERVER = 1;
const ObjcommCommand objcommREMOVE_OBSERVER = 2;
const ObjcommCommand objcommASSERT_READY = 3;
const ObjcommCommand objcommDEASSERT_READY = 4;

typedef unsigned int ObjcommVersion;
const ObjcommVersion objcommVERSION10 = 1;
const ObjcommVersion objcommVERSION20 = 2;
const ObjcommVersion objcommVERSION21 = 3;
const ObjcommVersion objcommVERSION22 = 4;
const ObjcommVersion objcommVERSION_UNDEF = 0xffffffff;

const int objcommMAX_DATA = 13;  ///< in one notice

/// A subject as its observer sees it, and what the observer still holds of it.
struct OSubjectInfo : public OServiceEntry {
  SubjectID id;  ///< the same as the base
  std::vector<RCRegion*> held;

  OSubjectInfo() {}
  explicit OSubjectInfo(const SubjectID& subject) : OServiceEntry(subject), id(subject) {}
  const SubjectID& GetID() const { return id; }
  const SubjectID& GetSubjectID() const { return id; }
  ObjcommVersion GetVersion() const { return objcommVERSION22; }
  const SubjectID& ID() const { return id; }
};

struct OPairBuffer;

/// An observer as its subject sees it.
struct OObserverInfo : public OServiceEntry {
  ObserverID id;  ///< the same as the base
  int ready;      ///< 1 asserted, 0 not known or just sent to, -1 deasserted
  OPairBuffer* buffer;

  OObserverInfo() : ready(0), buffer(0) {}
  explicit OObserverInfo(const ObserverID& observer) : OServiceEntry(observer), id(observer), ready(0), buffer(0) {}
  const ObserverID& GetID() const { return id; }
  const ObserverID& GetObserverID() const { return id; }
  const ObserverID& ID() const { return id; }
};

typedef OObserverInfo ObserverInfo;  // of earlier programs

typedef std::list<OObserverInfo>::const_iterator ObserverConstIterator;
typedef std::list<OObserverInfo>::iterator ObserverIterator;
typedef std::list<OSubjectInfo>::const_iterator SubjectConstIterator;
typedef std::list<OSubjectInfo>::iterator SubjectIterator;

struct OControlMessage {
  ObjcommCommand command;
  ObserverID observer;
  char name[oserviceNAME_MAX + 1];
};

struct OConnectMessage {
  OConnectCmd command;
  SubjectID subject;
  char name[oserviceNAME_MAX + 1];
};

struct OReadyMessage {
  ObjcommCommand command;
  ObserverID observer;
  int numRegions;
  RCRegion** regions;  ///< that come back
};

struct ONotifyMessage {
  SubjectID subject;
  int numNotify;
  int numData;
  RCRegion* data[objcommMAX_DATA];
};

#endif
