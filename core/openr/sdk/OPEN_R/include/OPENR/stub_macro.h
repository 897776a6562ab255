// For hand-written stubs that use subjects and observers: each entry in one line.
#ifndef BTR_OPENR_STUB_MACRO_H
#define BTR_OPENR_STUB_MACRO_H

#include <MCOOP.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OPENREvent.h>
#include <OPENR/OPENRMessages.h>
#include <OPENR/OSubject.h>
#include <OPENR/ObjcommMessages.h>
#include <ObjectEntryTable.h>
#include <apsys.h>

// Names of the functions, by the method or the number of subject or observer.
#define _Hook(name) _##name
#define _Control(id) _Control##id
#define _Ready(id) _Ready##id
#define _Connect(id) _Connect##id
#define _Notify(id) _Notify##id

#define StubFuncDeclare_Basic(name) extern "C" void _Hook(name)(OReasonMessage*);
#define StubFuncDeclare_Subject(id)               \
  extern "C" void _Control(id)(OControlMessage*); \
  extern "C" void _Ready(id)(OReadyMessage*);
#define StubFuncDeclare_Observer(id)              \
  extern "C" void _Connect(id)(OConnectMessage*); \
  extern "C" void _Notify(id)(ONotifyMessage*);

#define StubFuncDefine_Basic(name)                              \
  extern "C" void _Hook(name)(OReasonMessage * m) {             \
    Self.name(OSystemEvent(m->reason, m->param, m->paramSize)); \
    Exit();                                                     \
  }
#define StubFuncDefine_Control(id, method)                                                   \
  extern "C" void _Control(id)(OControlMessage * m) {                                        \
    const OStatus answer = Self.method(OControlEvent(id, m->observer, m->name, m->command)); \
    Self.subject[id]->ControlHandler(*m, answer);                                            \
    Exit();                                                                                  \
  }
#define StubFuncDefine_Control_nofunc(id)             \
  extern "C" void _Control(id)(OControlMessage * m) { \
    Self.subject[id]->ControlHandler(*m);             \
    Exit();                                           \
  }
#define StubFuncDefine_Ready(id, method)                   \
  extern "C" void _Ready(id)(OReadyMessage * m) {          \
    Self.subject[id]->ReadyHandler(*m);                    \
    Self.method(OReadyEvent(id, m->observer, m->command)); \
    Exit();                                                \
  }
#define StubFuncDefine_Ready_nofunc(id)           \
  extern "C" void _Ready(id)(OReadyMessage * m) { \
    Self.subject[id]->ReadyHandler(*m);           \
    Exit();                                       \
  }
#define StubFuncDefine_Connect(id, method)                                      \
  extern "C" void _Connect(id)(OConnectMessage * m) {                           \
    const OStatus answer = Self.method(OConnectEvent(id, m->name, m->command)); \
    Self.observer[id]->ConnectHandler(*m, answer);                              \
    Exit();                                                                     \
  }
#define StubFuncDefine_Connect_nofunc(id)             \
  extern "C" void _Connect(id)(OConnectMessage * m) { \
    Self.observer[id]->ConnectHandler(*m);            \
    Exit();                                           \
  }
#define StubFuncDefine_Notify(id, method)           \
  extern "C" void _Notify(id)(ONotifyMessage * m) { \
    ONotifyEvent event;                             \
    event.SetIndex(id);                             \
    Self.observer[id]->NotifyHandler(*m, &event);   \
    Self.method(event);                             \
    Exit();                                         \
  }
#define StubFuncDefine_Notify_nofunc(id)            \
  extern "C" void _Notify(id)(ONotifyMessage * m) { \
    ONotifyEvent event;                             \
    event.SetIndex(id);                             \
    Self.observer[id]->NotifyHandler(*m, &event);   \
    Exit();                                         \
  }

#endif
