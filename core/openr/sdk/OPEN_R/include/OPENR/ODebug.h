// What programs print and check while they are written.
#ifndef BTR_OPENR_ODEBUG_H
#define BTR_OPENR_ODEBUG_H

#include <OPENR/OStatus.h>
#include <OPENR/OSyslog.h>
#include <assert.h>
#include <stdio.h>

#ifdef OPENR_NO_DEBUG
#undef OPENR_DEBUG
#endif

/// The arguments of printf() stand in a second pair of parentheses.
#define PRINTF(arguments) (printf arguments)
#ifdef OPENR_DEBUG
#define ODEBUG(what) (what)
#define DPRINTF(arguments) (printf arguments)
#define DPRINTF2(when, arguments) \
  {                               \
    if (when) (printf arguments); \
  }
#else
#define ODEBUG(what)
#define DPRINTF(arguments)
#define DPRINTF2(when, arguments)
#endif

#endif
