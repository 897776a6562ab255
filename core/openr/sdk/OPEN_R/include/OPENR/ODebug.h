// What programs print and check while they are written.
#ifndef BTR_OPENR_ODEBUG_H
#define BTR_OPENR_ODEBUG_H

#include <OPENR/OStatus.h>
#include <OPENR/OSyslog.h>
#include <assert.h>

#endif
