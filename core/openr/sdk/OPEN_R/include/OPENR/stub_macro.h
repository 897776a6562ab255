// For hand-written stubs that use subjects and observers: each entry in one line.
#ifndef BTR_OPENR_STUB_MACRO_H
#define BTR_OPENR_STUB_MACRO_H

#include <MCOOP.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <ObjectEntryTable.h>
#include <apsys.h>

#endif
