#ifndef RelayStub_h
#define RelayStub_h
#include <OPENR/stub_macro.h>
StubFuncDeclare_Basic(Init) StubFuncDeclare_Basic(Start) StubFuncDeclare_Basic(Stop) StubFuncDeclare_Basic(Destroy)
    StubFuncDeclare_Subject(0) StubFuncDeclare_Observer(0)
#endif
