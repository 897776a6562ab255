#ifndef BTR_OPENR_OSUBJECTINFO_H
#define BTR_OPENR_OSUBJECTINFO_H

#include <OPENR/ObjcommTypes.h>

#endif
