// One band of one layer of the camera's picture.
#ifndef BTR_OPENR_OFBKIMAGE_H
#define BTR_OPENR_OFBKIMAGE_H

#include <OPENR/ODataFormats.h>

typedef int OFbkImageBand;
const OFbkImageBand ofbkimageBAND_Y = 0;
const OFbkImageBand ofbkimageBAND_Cr = 1;
const OFbkImageBand ofbkimageBAND_Cb = 2;
const OFbkImageBand ofbkimageBAND_CDT = 3;
const OFbkImageBand ofbkimageBAND_Y_LH = 4;
const OFbkImageBand ofbkimageBAND_Y_HL = 5;
const OFbkImageBand ofbkimageBAND_Y_HH = 6;

/// Rows of Width() bytes, Skip() bytes between one row's end and the next one's begin. The last row holds the tag: byte
/// 0–1 the field counter, from byte 4 the counts of the channels' pixels, in sixteens.
class OFbkImage {
 public:
  OFbkImage(OFbkImageInfo* info, byte* data, OFbkImageBand band);
  ~OFbkImage() {}

  bool IsValid() const { return pixels_ != 0; }
  byte* Pointer() const { return pixels_; }
  int Width() const { return width_; }
  int Height() const { return height_; }
  int Skip() const { return skip_; }
  byte Pixel(int x, int y) const { return pixels_[y * (width_ + skip_) + x]; }
  word FieldCounter() const { return static_cast<word>(tag_[0] | (tag_[1] << 8)); }
  byte ColorFrequency(OCdtChannel chan) const;
  longword GetTagInfo();

 private:
  byte* pixels_;
  const byte* tag_;
  int width_, height_, skip_;
};

#endif
