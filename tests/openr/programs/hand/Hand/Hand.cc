#include "Hand.h"
#include <OPENR/OSyslog.h>
static const Selector ENTRY_CONNECT = 4, ENTRY_NOTIFY = 5;
OStatus Hand::DoInit(const OSystemEvent& event) { observer = new OObserver; RegisterServiceEntry(OServiceEntry(myOID_, ENTRY_CONNECT), "Hand.Sensor.OSensorFrameVectorData.O"); observer->SetNotifyEntry(OServiceEntry(myOID_, ENTRY_NOTIFY)); return oSUCCESS; }
OStatus Hand::DoStart(const OSystemEvent& event) { observer->AssertReady(); return oSUCCESS; }
OStatus Hand::DoStop(const OSystemEvent& event) { observer->DeassertReady(); return oSUCCESS; }
OStatus Hand::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }
void Hand::Sensor(const ONotifyEvent& event) { if (n++ < 2) OSYSPRINT(("by hand %d\n", n)); observer->AssertReady(); }
