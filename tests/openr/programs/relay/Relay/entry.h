#ifndef entry_h_DEFINED
#define entry_h_DEFINED
#include <Types.h>
#include "def.h"
const Selector Entry_Hook[] = {0, 1, 2, 3};
const Selector Entry_Control[] = {4};
const Selector Entry_Ready[] = {5};
const Selector Entry_Connect[] = {6};
const Selector Entry_Notify[] = {7};
const int numOfHook = 4;
#endif
