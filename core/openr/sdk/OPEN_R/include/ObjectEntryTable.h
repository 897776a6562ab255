// The functions of an object that messages can call, closed by {UNDEF, ENTRY_UNDEF}.
#ifndef BTR_OPENR_OBJECT_ENTRY_TABLE_H
#define BTR_OPENR_OBJECT_ENTRY_TABLE_H

#include <Types.h>

struct ObjectEntry {
  Selector selector;
  Entry entry;
};

#define ENTRY_UNDEF 0

extern ObjectEntry ObjectEntryTable[];

#endif
