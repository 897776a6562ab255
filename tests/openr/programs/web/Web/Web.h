#ifndef Web_H
#define Web_H
#include <OPENR/OFbkImage.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <stdio.h>
extern "C" {
#include <jpeglib.h>
}
#include "def.h"
class Web : public OObject {
 public:
  Web();
  virtual ~Web() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);
  void Img(const ONotifyEvent& e);
  size_t Convert(OFbkImageVectorData* v, byte* out, size_t max);
};
#endif
