// Included before a source that does not compile without: what the robot's C library has beside the standard.
#ifndef BTR_OPENR_NEWLIB_H
#define BTR_OPENR_NEWLIB_H

#include <ctype.h>
#include <math.h>
#include <strings.h>

#define M_TWOPI (M_PI * 2.0)
#define M_3PI_4 (M_PI * 0.75)
#define M_SQRTPI 1.77245385090551602792981
#define M_SQRT3 1.73205080756887719000
#define M_LOG2_E M_LN2
#define M_INVLN2 (1 / M_LN2)

/// Writes the letters of `text` small, or large, where they stand.
static inline char* strlwr(char* text) {
  for (char* at = text; *at != '\0'; ++at) *at = static_cast<char>(tolower(static_cast<unsigned char>(*at)));
  return text;
}
static inline char* strupr(char* text) {
  for (char* at = text; *at != '\0'; ++at) *at = static_cast<char>(toupper(static_cast<unsigned char>(*at)));
  return text;
}

/// Comparisons without regard to large and small letters, by their names on other systems.
static inline int stricmp(const char* a, const char* b) { return strcasecmp(a, b); }
static inline int strcmpi(const char* a, const char* b) { return strcasecmp(a, b); }
static inline int strnicmp(const char* a, const char* b, size_t length) { return strncasecmp(a, b, length); }
static inline int strncmpi(const char* a, const char* b, size_t length) { return strncasecmp(a, b, length); }

#endif
