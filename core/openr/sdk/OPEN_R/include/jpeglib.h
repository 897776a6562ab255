/* The JPEG library of this computer for programs that bring a jpeg_mem_dest() of their own.
 */
#ifndef BTR_OPENR_JPEGLIB_H
#define BTR_OPENR_JPEGLIB_H

#include <stddef.h>
#include <stdio.h>

#define jpeg_mem_dest btr_openr_jpeg_mem_dest
#ifdef __cplusplus
extern "C" {
#endif
#include_next <jpeglib.h>
#ifdef __cplusplus
}
#endif
#undef jpeg_mem_dest

#endif
