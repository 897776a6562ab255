/* Included before every source: instructions that only the robot's processor has stop the program here, and what was
   compiled says with which headers. */
#ifndef BTR_OPENR_ROBOT_CPU_H
#define BTR_OPENR_ROBOT_CPU_H

#define BTR_OPENR_NO_INSTRUCTION(name) __asm__(".macro " #name " operands:vararg\n\tud2\n.endm")
BTR_OPENR_NO_INSTRUCTION(mfc0);
BTR_OPENR_NO_INSTRUCTION(mtc0);
BTR_OPENR_NO_INSTRUCTION(mfc1);
BTR_OPENR_NO_INSTRUCTION(mtc1);
BTR_OPENR_NO_INSTRUCTION(eret);
BTR_OPENR_NO_INSTRUCTION(tlbp);
BTR_OPENR_NO_INSTRUCTION(tlbr);
BTR_OPENR_NO_INSTRUCTION(tlbwi);
BTR_OPENR_NO_INSTRUCTION(tlbwr);
BTR_OPENR_NO_INSTRUCTION(break);
#undef BTR_OPENR_NO_INSTRUCTION
/* What only orders or hints does nothing. */
#define BTR_OPENR_NOTHING(name) __asm__(".macro " #name " operands:vararg\n.endm")
BTR_OPENR_NOTHING(sync);
BTR_OPENR_NOTHING(pref);
BTR_OPENR_NOTHING(cache);
BTR_OPENR_NOTHING(ssnop);
#undef BTR_OPENR_NOTHING

/* How its bytes lie, as sources for several computers ask; not that it is a MIPS, which asks for assembler. A source
   that has assembler for this one is compiled again without it. */
#if !defined(__MIPSEL__) && !defined(BTR_OPENR_THIS_CPU)
#define __MIPSEL__ 1
#define __MIPSEL 1
#define _MIPSEL 1
#define MIPSEL 1
#endif

#include "btr_openr_version.h"
#ifdef __cplusplus
#include "btr_old_operators.h"
#endif

#ifdef __cplusplus
extern "C" {
#endif
__attribute__((weak, used)) char btr_openr_headers[] = BTR_OPENR_MARK BTR_OPENR_VERSION;
#ifdef __cplusplus
}
#endif

#endif
