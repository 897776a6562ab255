#ifndef BTR_OPENR_OOBSERVERINFO_H
#define BTR_OPENR_OOBSERVERINFO_H

#include <OPENR/ObjcommTypes.h>

#endif
