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

/// The object waits, and only it, in simulated time. The unit of the robot's own call is not known: nanoseconds here.
sError Wait(longlong nanoseconds);

/// Memory of the object's own.
sError NewRegion(size_t size, void** address);
/// Memory that objects share.
sError NewSharedMemoryRegion(size_t size, void** address, MemoryRegionID* id);
/// sINVALID_ARG for what New… did not make.
sError DeleteRegion(void* address);
sError DeleteSharedMemoryRegion(MemoryRegionID id);

template <class T>
sError NewRegion(size_t size, T** address) {
  return NewRegion(size, reinterpret_cast<void**>(address));
}
inline sError NewSharedMemoryRegion(size_t size, void** address) { return NewSharedMemoryRegion(size, address, 0); }
inline sError NewSharedMemoryRegion(size_t size, MemoryRegionID* id, void** address) {
  return NewSharedMemoryRegion(size, address, id);
}
inline sError NewSharedMemoryRegion(MemoryRegionID* id, size_t size, void** address) {
  return NewSharedMemoryRegion(size, address, id);
}
inline sError NewSharedMemoryRegion(MemoryRegionID* id, void** address, size_t size) {
  return NewSharedMemoryRegion(size, address, id);
}
inline sError NewSharedMemoryRegion(void** address, size_t size, MemoryRegionID* id) {
  return NewSharedMemoryRegion(size, address, id);
}
template <class T>
sError NewSharedMemoryRegion(size_t size, T** address) {
  return NewSharedMemoryRegion(size, reinterpret_cast<void**>(address), static_cast<MemoryRegionID*>(0));
}
template <class T>
sError NewSharedMemoryRegion(size_t size, T** address, MemoryRegionID* id) {
  return NewSharedMemoryRegion(size, reinterpret_cast<void**>(address), id);
}
template <class T>
sError NewSharedMemoryRegion(size_t size, MemoryRegionID* id, T** address) {
  return NewSharedMemoryRegion(size, reinterpret_cast<void**>(address), id);
}
template <class T>
sError NewSharedMemoryRegion(MemoryRegionID* id, size_t size, T** address) {
  return NewSharedMemoryRegion(size, reinterpret_cast<void**>(address), id);
}

/// The object whose method runs.
sError WhoAmI(OID* id);

#endif
