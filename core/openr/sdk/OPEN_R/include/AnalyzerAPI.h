// What looks into the system: how much memory is left.
#ifndef BTR_OPENR_ANALYZERAPI_H
#define BTR_OPENR_ANALYZERAPI_H

#include <AnalyzerError.h>
#include <Types.h>
#include <stddef.h>

/// Of the robot's 64 MB, less what the program holds [bytes].
AnalyzerError AnalyzerGetSizeOfFreeMemory(size_t* bytes);
inline AnalyzerError AnalyzerGetSizeOfFreeMemory(unsigned* bytes) {
  size_t size = 0;
  const AnalyzerError error = AnalyzerGetSizeOfFreeMemory(&size);
  if (bytes != NULL) *bytes = (unsigned)size;
  return error;
}

#endif
