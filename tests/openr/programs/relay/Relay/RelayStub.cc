#ifndef OPENR_STUBGEN
#define OPENR_STUBGEN
#endif
#include <MCOOP.h>
#include <InitInfo.h>
#include <iostream.h>
#include <Context.h>
#include <Types.h>
#include <OPENR/stub_macro.h>
#include "def.h"
#include "entry.h"
#include "RelayStub.h"
#include "Relay.h"
Relay Self;
StubFuncDefine_Basic(Init)
StubFuncDefine_Basic(Start)
StubFuncDefine_Basic(Stop)
StubFuncDefine_Basic(Destroy)
StubFuncDefine_Control_nofunc(0)
StubFuncDefine_Ready(0, Ready)
StubFuncDefine_Connect_nofunc(0)
StubFuncDefine_Notify(0, Update)
ObjectEntry ObjectEntryTable[] = { {0, (Entry)_Init}, {1, (Entry)_Start}, {2, (Entry)_Stop}, {3, (Entry)_Destroy},
  {4, (Entry)_Control0}, {5, (Entry)_Ready0}, {6, (Entry)_Connect0}, {7, (Entry)_Notify0}, {UNDEF, (Entry)ENTRY_UNDEF} };
