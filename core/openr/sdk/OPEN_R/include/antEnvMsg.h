// Messages to the IP stack.
#ifndef BTR_OPENR_ANTENVMSG_H
#define BTR_OPENR_ANTENVMSG_H

#include <OPENR/OPENR.h>
#include <antModuleRef.h>
#include <antSharedBuffer.h>
#include <antStackRef.h>
#include <antTypes.h>

enum { Entry_antEnv_Initialize = 0, Entry_antEnv_HartBeat, Entry_antEnv_External, antEnv_numEntries };

enum antEnvMsgInvocation { ANTENVMSG_SEND = 0, ANTENVMSG_CALL };

class antEnvMsgContInfo : public TID {
 public:
  antEnvMsgContInfo() {}
  antEnvMsgContInfo(TID& _tid) : TID(_tid) {}
  antEnvMsgContInfo(OID _target, uint32 _selector) : TID(_target, _selector) {}
  OID GetOID() { return oid_; }
  uint32 GetSelector() { return selector_; }
};

class antEnvMsg {
 public:
  Selector dstSelector;
  antModuleRef dstModule;
  int32 dstOperation;
  OID sender;
  int32 msgSize;
  antEnvMsgInvocation invocationType;
  antEnvMsgContInfo contInfo;
  void* continuation;  ///< comes back as it was

  antEnvMsg()
      : dstSelector(Entry_antEnv_External),
        dstOperation(0),
        msgSize(0),
        invocationType(ANTENVMSG_SEND),
        continuation(0) {}
  antEnvMsg(int32 _operation, Selector selector = Entry_antEnv_External)
      : dstSelector(selector), dstOperation(_operation), msgSize(0), invocationType(ANTENVMSG_SEND), continuation(0) {}
  antEnvMsg(antModuleRef _module, int32 _operation, Selector selector = Entry_antEnv_External)
      : dstSelector(selector),
        dstModule(_module),
        dstOperation(_operation),
        msgSize(0),
        invocationType(ANTENVMSG_SEND),
        continuation(0) {}

  antError Reply() { return ANT_SUCCESS; }
  /// The operation begins; when it has ended, the sender's entry `_selector` is given a copy of this with the answer.
  antError Send(antStackRef _target, OID& _sender, int32 _selector, int _msgSize);
  /// The operation, until it has ended; the answer stands in this message.
  antError Call(antStackRef _dest, int _msgSize);
  static antEnvMsg* Receive(ANTENVMSG _msg) { return static_cast<antEnvMsg*>(_msg); }
  int32 GetOperation() { return dstOperation; }
  OID& GetSender() { return sender; }
};

// Operations of the stack itself; those of an endpoint are numbered from 0.
const int32 antEnv_Operation_CreateSharedBuffer = 10001;
const int32 antEnv_Operation_DestroySharedBuffer = 10002;
const int32 antEnv_Operation_CreateEndpoint = 10003;
const int32 antEnv_Operation_DestroyEndpoint = 10004;
const int32 antEnv_Operation_InitSetParam = 10005;
const int32 antEnv_Operation_InitGetParam = 10006;

class antEnvCreateSharedBufferMsg : public antEnvMsg {
 public:
  antError error;
  int32 size;
  antSharedBuffer buffer;
  antEnvCreateSharedBufferMsg() : antEnvMsg(antEnv_Operation_CreateSharedBuffer), error(ANT_SUCCESS), size(0) {}
  antEnvCreateSharedBufferMsg(int32 _size)
      : antEnvMsg(antEnv_Operation_CreateSharedBuffer), error(ANT_SUCCESS), size(_size) {}
};

class antEnvDestroySharedBufferMsg : public antEnvMsg {
 public:
  antError error;
  antSharedBuffer buffer;
  antEnvDestroySharedBufferMsg() : antEnvMsg(antEnv_Operation_DestroySharedBuffer), error(ANT_SUCCESS) {}
  antEnvDestroySharedBufferMsg(const antSharedBuffer& _buffer)
      : antEnvMsg(antEnv_Operation_DestroySharedBuffer), error(ANT_SUCCESS), buffer(_buffer) {}
};

class antEnvCreateEndpointMsg : public antEnvMsg {
 public:
  antError error;
  int32 protocol;  ///< EndpointType_…
  int32 poolSize;
  antModuleRef moduleRef;
  antEnvCreateEndpointMsg()
      : antEnvMsg(antEnv_Operation_CreateEndpoint), error(ANT_SUCCESS), protocol(0), poolSize(0) {}
  antEnvCreateEndpointMsg(int32 _protocol, int32 _poolSize = 0)
      : antEnvMsg(antEnv_Operation_CreateEndpoint), error(ANT_SUCCESS), protocol(_protocol), poolSize(_poolSize) {}
};

class antEnvDestroyEndpointMsg : public antEnvMsg {
 public:
  antError error;
  antModuleRef moduleRef;
  antEnvDestroyEndpointMsg() : antEnvMsg(antEnv_Operation_DestroyEndpoint), error(ANT_SUCCESS) {}
  antEnvDestroyEndpointMsg(const antModuleRef& _ref)
      : antEnvMsg(antEnv_Operation_DestroyEndpoint), error(ANT_SUCCESS), moduleRef(_ref) {}
};

// Settings of the stack, as WLANCONF.TXT has them: "ETHER_IP", "ESSID" …
#define ANTENV_KEY_LENGTH_MAX 32
#define ANTENV_VALUE_LENGTH_MAX 32

enum { antEnv_InitParam_Int32 = -1, antEnv_InitParam_String = -2 };

/// A setting with its key and value; its value is cut at the last character that has room.
class antEnvInitParamMsg : public antEnvMsg {
 public:
  int32 paramType;
  char key[ANTENV_KEY_LENGTH_MAX];
  union {
    char str[ANTENV_VALUE_LENGTH_MAX];
    int32 i32;
  } value;
  antError error;

 protected:
  antEnvInitParamMsg(int32 operation, const char* _key)
      : antEnvMsg(operation), paramType(antEnv_InitParam_String), error(ANT_SUCCESS) {
    copy(key, _key, ANTENV_KEY_LENGTH_MAX);
    value.str[0] = 0;
  }
  static void copy(char* to, const char* from, int room) {
    int i = 0;
    for (; from != 0 && from[i] != 0 && i < room - 1; ++i) to[i] = from[i];
    to[i] = 0;
  }
};

class antEnvInitSetParamMsg : public antEnvInitParamMsg {
 public:
  antEnvInitSetParamMsg() : antEnvInitParamMsg(antEnv_Operation_InitSetParam, 0) {}
  antEnvInitSetParamMsg(const char* _key, int32 number) : antEnvInitParamMsg(antEnv_Operation_InitSetParam, _key) {
    paramType = antEnv_InitParam_Int32;
    value.i32 = number;
  }
  antEnvInitSetParamMsg(const char* _key, const char* text) : antEnvInitParamMsg(antEnv_Operation_InitSetParam, _key) {
    copy(value.str, text, ANTENV_VALUE_LENGTH_MAX);
  }
};

/// Its error is ANT_REGISTRY_NO_KEY if nobody set that.
class antEnvInitGetParamMsg : public antEnvInitParamMsg {
 public:
  antEnvInitGetParamMsg() : antEnvInitParamMsg(antEnv_Operation_InitGetParam, 0) {}
  antEnvInitGetParamMsg(const char* _key) : antEnvInitParamMsg(antEnv_Operation_InitGetParam, _key) {}
};

#endif
