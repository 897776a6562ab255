// What stubs of earlier programs include; nothing of it is needed here.
#ifndef BTR_OPENR_INITINFO_H
#define BTR_OPENR_INITINFO_H

#include <MCOOP.h>

#endif
