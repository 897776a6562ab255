// The IP stack: endpoints, shared buffers, messages.
#ifndef BTR_OPENR_ANT_H
#define BTR_OPENR_ANT_H

#include <EndpointTypes.h>
#include <IPAddress.h>
#include <antEnvMsg.h>
#include <antModuleRef.h>
#include <antSharedBuffer.h>
#include <antStackRef.h>
#include <antTypes.h>

#endif
