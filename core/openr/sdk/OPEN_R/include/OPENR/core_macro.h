// Statements for the members of a core class with `subject[]` and `observer[]`. entry.h is the stub's, where the folder
// of an object is known; sources that several objects share have none, or include theirs by another path.
#ifndef BTR_OPENR_CORE_MACRO_H
#define BTR_OPENR_CORE_MACRO_H

#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#if __has_include("entry.h")
#include "entry.h"
#endif

#define BTR_OPENR_EACH_SUBJECT for (int btrI = 0; btrI < (int)numOfSubject; ++btrI)
#define BTR_OPENR_EACH_OBSERVER for (int btrI = 0; btrI < (int)numOfObserver; ++btrI)

#define NEW_ALL_SUBJECT_AND_OBSERVER                              \
  {                                                               \
    BTR_OPENR_EACH_SUBJECT { subject[btrI] = new OSubject(); }    \
    BTR_OPENR_EACH_OBSERVER { observer[btrI] = new OObserver(); } \
  }

#define DELETE_ALL_SUBJECT_AND_OBSERVER \
  {}

#define REGISTER_ALL_ENTRY                                                                                             \
  {                                                                                                                    \
    BTR_OPENR_EACH_SUBJECT { RegisterServiceEntry(OServiceEntry(myOID_, Entry_Control[btrI]), subjectService[btrI]); } \
    BTR_OPENR_EACH_OBSERVER {                                                                                          \
      RegisterServiceEntry(OServiceEntry(myOID_, Entry_Connect[btrI]), observerService[btrI]);                         \
    }                                                                                                                  \
  }

#define SET_ALL_READY_AND_NOTIFY_ENTRY                                                                     \
  {                                                                                                        \
    BTR_OPENR_EACH_SUBJECT { subject[btrI]->SetReadyEntry(OServiceEntry(myOID_, Entry_Ready[btrI])); }     \
    BTR_OPENR_EACH_OBSERVER { observer[btrI]->SetNotifyEntry(OServiceEntry(myOID_, Entry_Notify[btrI])); } \
  }

#define ENABLE_ALL_SUBJECT \
  {}

#define DISABLE_ALL_SUBJECT                                  \
  {                                                          \
    BTR_OPENR_EACH_SUBJECT { subject[btrI]->ClearBuffer(); } \
  }

#define ASSERT_READY_TO_ALL_OBSERVER                           \
  {                                                            \
    BTR_OPENR_EACH_OBSERVER { observer[btrI]->AssertReady(); } \
  }

#define DEASSERT_READY_TO_ALL_OBSERVER                           \
  {                                                              \
    BTR_OPENR_EACH_OBSERVER { observer[btrI]->DeassertReady(); } \
  }

// Names of older programs.
#define ASSERT_ALL_READY ASSERT_READY_TO_ALL_OBSERVER
#define DEASSERT_ALL_READY DEASSERT_READY_TO_ALL_OBSERVER
#define ASSERT_TO_ALL_OBSERVER ASSERT_READY_TO_ALL_OBSERVER
#define DEASSERT_TO_ALL_OBSERVER DEASSERT_READY_TO_ALL_OBSERVER
#define NewComData NEW_ALL_SUBJECT_AND_OBSERVER
#define DeleteComData DELETE_ALL_SUBJECT_AND_OBSERVER
#define SetComData                 \
  {                                \
    REGISTER_ALL_ENTRY             \
    SET_ALL_READY_AND_NOTIFY_ENTRY \
  }

#endif
