// Calls of the robot's operating system: memory and time.
#ifndef BTR_OPENR_APSYS_H
#define BTR_OPENR_APSYS_H

#include <OID.h>
#include <SystemTime.h>
#include <Types.h>

typedef longword sError;
const sError sSUCCESS = 0;
const sError sFAIL = 1;
const sError sINVALID_ARG = 2;
const sError sNO_MEMORY = 3;
const sError sNOT_FOUND = 4;

sError GetSystemTime(SystemTime* time);
sError GetSystemTime(structSystemTime* time);

/// The object waits, and only it, in simulated time.
sError Wait(longlong nanoseconds);

/// Memory of the object's own.
sError NewRegion(size_t size, void** address);
/// Memory that objects share. Writing to it with MEMPROTINFO_R ends the program.
sError NewSharedMemoryRegion(size_t size, MemoryProtectionInfo info, MemoryRegionID* id, void** address);
/// Where another object's region is: at the same place in all objects.
sError AttachMemoryRegion(MemoryRegionID id, MemoryProtectionInfo info, void** address);
sError DetachMemoryRegion(MemoryRegionID id);
/// Everybody may.
sError AllowToAttachMemoryRegion(MemoryRegionID id, MemoryProtectionInfo info, OID who, bool givingOwnership);
sError DeleteSharedMemoryRegion(MemoryRegionID id);
/// sINVALID_ARG for what NewRegion() did not make.
sError DeleteRegion(void* address);

template <class T>
sError NewRegion(size_t size, T** address) {
  return NewRegion(size, reinterpret_cast<void**>(address));
}

/// Regions are made of pages of so many bytes; programs that share memory ask for whole ones.
sError GetPageSize(longword* bytes);
inline sError GetPageSize(size_t* bytes) {
  longword size = 0;
  const sError error = GetPageSize(&size);
  *bytes = size;
  return error;
}
inline sError GetPageSize(int* bytes) { return GetPageSize(reinterpret_cast<longword*>(bytes)); }

/// The object whose method runs.
sError WhoAmI(OID* id);

#endif
