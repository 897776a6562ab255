// Lines on the console. The arguments stand in a second pair of parentheses.
#ifndef BTR_OPENR_OSYSLOG_H
#define BTR_OPENR_OSYSLOG_H

#include <Types.h>

typedef longword OSyslogPriority;
const OSyslogPriority osyslogERROR = 1;
const OSyslogPriority osyslogWARNING = 2;
const OSyslogPriority osyslogINFO = 3;

void OSyslog1(longword priority, const char* format, ...);
void OSysprint(const char* format, ...);

/// "[oid:…,prio:n] text" and a new line.
#define OSYSLOG1(arguments) OSyslog1 arguments
/// The bare text, at most 243 characters.
#define OSYSPRINT(arguments) OSysprint arguments
#ifdef OPENR_DEBUG
#define OSYSDEBUG(arguments) OSysprint arguments
#else
#define OSYSDEBUG(arguments) ((void)0)
#endif

#endif
