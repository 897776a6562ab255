#ifndef BTR_OPENR_OBJCOMMMESSAGES_H
#define BTR_OPENR_OBJCOMMMESSAGES_H

#include <OPENR/ObjcommTypes.h>

#endif
