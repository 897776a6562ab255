/* Numbers as the robot's processor has them: a longword is 32 bits here too. */
#ifndef BTR_OPENR_TYPES_H
#define BTR_OPENR_TYPES_H

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

typedef unsigned char byte;
typedef unsigned short word;
typedef unsigned int longword;
typedef signed char sbyte;
typedef short sword;
typedef int slongword;
typedef long long longlong;
typedef unsigned long long ulonglong;
typedef long long slonglong;

typedef signed char int8;
typedef short int16;
typedef int int32;
typedef unsigned char uint8;
typedef unsigned short uint16;
typedef unsigned int uint32;
typedef long long int64;
typedef unsigned long long uint64;

#ifdef __cplusplus
#include <btr_sizes.h>
typedef bool Boolean;
#else
typedef unsigned char Boolean;
#endif
typedef int boolean; /* as the JPEG library has it */

typedef longword Selector;
typedef unsigned int MemoryRegionID;
typedef MemoryRegionID SharedMemoryRegionID;
typedef enum { MEMPROTINFO_INVALID = 0, MEMPROTINFO_R = 1, MEMPROTINFO_RW = 2 } MemoryProtectionInfo;
typedef MemoryProtectionInfo SharedMemoryProtectionInfo;
typedef longword offset_t;
#ifdef __cplusplus
typedef void (*Entry)(...);
#else
typedef void (*Entry)();
#endif

#define UNDEF 0xffffffff

/* The C library has it no longer, old programs ask for it. */
#ifdef __cplusplus
extern "C" char* gets(char* line);
#else
char* gets(char* line);
#endif

#endif
