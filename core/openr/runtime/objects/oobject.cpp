// The core class: its hooks and services.
#include <OPENR/OObject.h>

#include "core/openr/runtime/objects/system.h"

using btr::openr::System;

namespace {

/// [undocumented] What follows when a hook answers something else than oSUCCESS: it is said, the object goes on.
void report(const char* hook, OStatus status) {
  if (status == oSUCCESS) return;
  System& system = System::instance();
  if (auto* object = system.current())
    system.say(object->name, std::string(hook) + " answered status " + std::to_string(status) + ", not oSUCCESS");
}

}  // namespace

OObject::OObject() {
  if (auto* object = System::instance().current()) myOID_ = object->oid;
}
OObject::~OObject() = default;
void OObject::Init(const OSystemEvent& event) { report("DoInit", DoInit(event)); }
void OObject::Start(const OSystemEvent& event) { report("DoStart", DoStart(event)); }
void OObject::Stop(const OSystemEvent& event) { report("DoStop", DoStop(event)); }
void OObject::Destroy(const OSystemEvent& event) { report("DoDestroy", DoDestroy(event)); }
OStatus OObject::DoInit(const OSystemEvent&) { return oSUCCESS; }
OStatus OObject::DoStart(const OSystemEvent&) { return oSUCCESS; }
OStatus OObject::DoStop(const OSystemEvent&) { return oSUCCESS; }
OStatus OObject::DoDestroy(const OSystemEvent&) { return oSUCCESS; }

OStatus OObject::RegisterServiceEntry(const OServiceEntry& entry, const char* name) {
  auto* object = System::instance().objectOf(entry.oid);
  if (object == nullptr) return oINVALID_OID;
  const std::string service = name;
  if (service.size() < 2) return oINVALID_ARG;
  (service.back() == 'S' ? object->subjects : object->observers).push_back({service, entry});
  return oSUCCESS;
}
