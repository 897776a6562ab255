#ifndef BTR_OPENR_OOBJECT_H
#define BTR_OPENR_OOBJECT_H

#include <OPENR/OPENR.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OPENREvent.h>
#include <OPENR/OPENRMessages.h>
#include <OPENR/OSyslog.h>
#include <TimeEventInfo.h>
#include <apsys.h>

/// What a core class is derived from. There is one instance of it, the stub's.
class OObject {
 public:
  OObject();
  virtual ~OObject();

  void Init(const OSystemEvent& event);
  void Start(const OSystemEvent& event);
  void Stop(const OSystemEvent& event);
  void Destroy(const OSystemEvent& event);

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

 protected:
  /// `name` is a service of this object: "Object.Sub.Type.S" or ".O"; `entry` its Control or Connect.
  OStatus RegisterServiceEntry(const OServiceEntry& entry, const char* name);

  OID myOID_;
};

#endif
