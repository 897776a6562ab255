/* The JPEG library of this computer for programs that bring a jpeg_mem_dest() of their own and have a type "boolean".
 */
#ifndef BTR_OPENR_JPEGLIB_H
#define BTR_OPENR_JPEGLIB_H

#include <stddef.h>
#include <stdio.h>

#define boolean btr_openr_jpeg_boolean
#define jpeg_mem_dest btr_openr_jpeg_mem_dest
#ifdef __cplusplus
extern "C" {
#endif
#include_next <jpeglib.h>
#ifdef __cplusplus
}
#endif
#undef jpeg_mem_dest
#undef boolean

#endif
