// scanf() and its kin. On the robot a `long` had 32 bits, and programs read a longword by "%ld"; here "%ld" would write
// 64. So each integer is read as wide as the variable that it goes to.
#ifndef BTR_OPENR_SCAN_H
#define BTR_OPENR_SCAN_H

#include <cstdio>
#include <cstring>

/// Bytes of what an argument of scanf() points to; 0: not known, or text.
template <class T>
inline unsigned char btr_scan_width(T* const&) {
  return sizeof(T) == 4 || sizeof(T) == 8 ? sizeof(T) : 0;
}
inline unsigned char btr_scan_width(...) { return 0; }

class btr_scan_format {
 public:
  btr_scan_format(const char* format, const unsigned char* widths, int count) : text_(format) {
    if (std::strlen(format) >= sizeof(own_) / 2) return;
    text_ = own_;
    char* to = own_;
    int next = 0;
    for (const char* at = format; *at != 0;) {
      if ((*to++ = *at++) != '%') continue;
      const bool assigned = *at != '*' && *at != '%';
      while (*at == '*' || (*at >= '0' && *at <= '9')) *to++ = *at++;
      const char* modifier = at;
      while (*at != 0 && std::strchr("hlLqjzt", *at) != 0) ++at;
      const bool integer = *at != 0 && std::strchr("diouxXn", *at) != 0;
      const bool narrow = *modifier == 'h';
      const unsigned char width = assigned && next < count ? widths[next] : 0;
      if (integer && !narrow && width == 8) {
        *to++ = 'l';
      } else if (!(integer && !narrow && width == 4)) {
        while (modifier != at) *to++ = *modifier++;
      }
      if (assigned) ++next;
      if (*at == '[') {  // up to its end, which may stand first in it
        *to++ = *at++;
        if (*at == '^') *to++ = *at++;
        if (*at == ']') *to++ = *at++;
        while (*at != 0 && *at != ']') *to++ = *at++;
      }
      if (*at != 0) *to++ = *at++;
    }
    *to = 0;
  }
  const char* text() const { return text_; }

 private:
  btr_scan_format(const btr_scan_format&);
  btr_scan_format& operator=(const btr_scan_format&);
  const char* text_;
  char own_[512];
};

#define BTR_OPENR_SCAN_FORMAT                                       \
  const unsigned char widths[] = {btr_scan_width(arguments)..., 0}; \
  const btr_scan_format now(format, widths, (int)sizeof...(Arguments))

template <class... Arguments>
inline int btr_fscanf(std::FILE* from, const char* format, Arguments... arguments) {
  BTR_OPENR_SCAN_FORMAT;
  return std::fscanf(from, now.text(), arguments...);
}
template <class... Arguments>
inline int btr_sscanf(const char* from, const char* format, Arguments... arguments) {
  BTR_OPENR_SCAN_FORMAT;
  return std::sscanf(from, now.text(), arguments...);
}
template <class... Arguments>
inline int btr_scanf(const char* format, Arguments... arguments) {
  BTR_OPENR_SCAN_FORMAT;
  return std::scanf(now.text(), arguments...);
}
namespace std {
using ::btr_fscanf;
using ::btr_scanf;
using ::btr_sscanf;
}  // namespace std

#undef BTR_OPENR_SCAN_FORMAT
#define fscanf btr_fscanf
#define sscanf btr_sscanf
#define scanf btr_scanf

#endif
