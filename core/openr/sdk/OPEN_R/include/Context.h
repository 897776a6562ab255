// What stubs of earlier programs include; nothing of it is needed here.
#ifndef BTR_OPENR_CONTEXT_H
#define BTR_OPENR_CONTEXT_H

#include <MCOOP.h>

#endif
