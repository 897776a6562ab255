// What a hand-written stub needs: its entries leave no trace in the operating system here.
#ifndef BTR_OPENR_MCOOP_H
#define BTR_OPENR_MCOOP_H

#include <OID.h>
#include <ObjectEntryTable.h>
#include <Types.h>
#include <apsys.h>

/// Defines `entry`, which calls `function` with the message it is given.
#define GEN_ENTRY(entry, function) \
  extern "C" void entry(void* message) { (reinterpret_cast<void (*)(void*)>(::function))(message); }

inline void Exit() {}
inline void Return() {}
extern "C" void Prologue();

#endif
