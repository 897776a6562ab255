// Assembler of the robot's processor beside this one's, a header by another case, memory that is left.
#include <AnalyzerAPI.h>
#include <EtherDriverMsg.h>
#include <OPENR/core_macro.h>
#include "idiom.H"
struct EtherDriverGetMACAddressMsg;
static unsigned where() {
  unsigned at = 0;
#if defined(__MIPSEL__)
  __asm__ __volatile__("move %0,$gp\n\tjal readpc\n\tnop" : "=r"(at));
#elif defined(__x86_64__)
  __asm__ __volatile__("movl $77,%0" : "=r"(at));
#else
#error "neither processor"
#endif
  return at;
}
void Idiom::machine() {
  size_t left = 0;
  bool known = AnalyzerGetSizeOfFreeMemory(&left) == azrSUCCESS;
  printf("machine %u, memory %d %d\n", where(), known, left > 1000000 && left < 64 << 20);
}
