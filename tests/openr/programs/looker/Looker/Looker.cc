#include "Looker.h"

#include <OPENR/OFbkImage.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OPrimitiveControl.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

Looker::Looker() {}

OStatus Looker::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  OPENR::OpenPrimitive("PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1", &camera);
  MemoryRegionID memory;
  OCdtVectorData* vector;
  OPENR::NewCdtVectorData(&memory, &vector);
  vector->SetNumData(2);
  vector->GetInfo(0)->Init(camera, ocdtCHANNEL0);
  for (int y = 0; y < ocdtMAX_Y_SEGMENT; y++) vector->GetInfo(0)->Set(y, 230, 190, 150, 120);
  vector->GetInfo(1)->Init(camera, ocdtCHANNEL6);  // nothing
  const OStatus set = OPENR::SetCdtVectorData(memory), deleted = OPENR::DeleteCdtVectorData(memory);
  OSYSPRINT(("cdt %d %d\n", set, deleted));
  OPrimitiveControl_CameraParam fast(ocamparamSHUTTER_FAST), odd(17);
  OSYSPRINT(("shutter %d %d\n",
             OPENR::ControlPrimitive(camera, oprmreqCAM_SET_SHUTTER_SPEED, &fast, sizeof(fast), 0, 0),
             OPENR::ControlPrimitive(camera, oprmreqCAM_SET_GAIN, &odd, sizeof(odd), 0, 0)));
  return oSUCCESS;
}

OStatus Looker::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;

  return oSUCCESS;
}

OStatus Looker::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Looker::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void Looker::Notify(const ONotifyEvent& event) {
  OFbkImageVectorData* vector = (OFbkImageVectorData*)event.Data(0);
  static int count = 0;
  if (count++ == 0) {
    for (int layer = ofbkimageLAYER_H; layer <= ofbkimageLAYER_L; layer++) {
      OFbkImageInfo* info = vector->GetInfo(layer);
      byte* data = vector->GetData(layer);
      OFbkImage y(info, data, ofbkimageBAND_Y), cr(info, data, ofbkimageBAND_Cr), cb(info, data, ofbkimageBAND_Cb);
      OFbkImage lh(info, data, ofbkimageBAND_Y_LH), wrong(info, data, ofbkimageBAND_CDT);
      OSYSPRINT(("layer %d: %d x %d skip %d valid %d %d, y %d cr %d cb %d lh %d\n", layer, y.Width(), y.Height(),
                 y.Skip(), y.IsValid(), wrong.IsValid(), y.Pixel(4, 5), cr.Pixel(4, 5), cb.Pixel(4, 5),
                 lh.Pixel(4, 5)));
    }
    OFbkImage found(vector->GetInfo(ofbkimageLAYER_C), vector->GetData(ofbkimageLAYER_C), ofbkimageBAND_CDT);
    OSYSPRINT(("cdt %d x %d, %d %d, frequency %d %d, field %d\n", found.Width(), found.Height(), found.Pixel(20, 12),
               found.Pixel(4, 5), found.ColorFrequency(ocdtCHANNEL0), found.ColorFrequency(ocdtCHANNEL6),
               found.FieldCounter()));
  }
  observer[event.ObsIndex()]->AssertReady();
}
