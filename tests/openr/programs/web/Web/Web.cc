#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OUnits.h>
#include <OPENR/core_macro.h>
#include "Web.h"
#include "entry.h"
Web::Web() {}
OStatus Web::DoInit(const OSystemEvent& event) {
 NEW_ALL_SUBJECT_AND_OBSERVER; REGISTER_ALL_ENTRY; SET_ALL_READY_AND_NOTIFY_ENTRY;
 return oSUCCESS; }
OStatus Web::DoStart(const OSystemEvent& event) {
 ENABLE_ALL_SUBJECT; ASSERT_READY_TO_ALL_OBSERVER;
 return oSUCCESS; }
OStatus Web::DoStop(const OSystemEvent& event) {
 DISABLE_ALL_SUBJECT; DEASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Web::DoDestroy(const OSystemEvent& event) { DELETE_ALL_SUBJECT_AND_OBSERVER; return oSUCCESS; }
#include <setjmp.h>
extern "C" {
typedef struct { struct jpeg_destination_mgr pub; JOCTET* buf; size_t max; size_t* size; } mem_dest;
static void init_d(j_compress_ptr c) { mem_dest* d = (mem_dest*)c->dest; d->pub.next_output_byte = d->buf; d->pub.free_in_buffer = d->max; }
static boolean empty_d(j_compress_ptr c) { return FALSE; }
static void term_d(j_compress_ptr c) { mem_dest* d = (mem_dest*)c->dest; *d->size = d->max - d->pub.free_in_buffer; }
void jpeg_mem_dest(j_compress_ptr c, JOCTET* buf, size_t max, size_t* size) { mem_dest* d; if (c->dest == NULL) c->dest = (struct jpeg_destination_mgr*)(*c->mem->alloc_small)((j_common_ptr)c, JPOOL_PERMANENT, sizeof(mem_dest)); d = (mem_dest*)c->dest; d->pub.init_destination = init_d; d->pub.empty_output_buffer = empty_d; d->pub.term_destination = term_d; d->buf = buf; d->max = max; d->size = size; }
}
size_t Web::Convert(OFbkImageVectorData* v, byte* out, size_t max) {
  OFbkImage y(v->GetInfo(0), v->GetData(0), ofbkimageBAND_Y), cr(v->GetInfo(0), v->GetData(0), ofbkimageBAND_Cr), cb(v->GetInfo(0), v->GetData(0), ofbkimageBAND_Cb);
  struct jpeg_compress_struct c; struct jpeg_error_mgr err; c.err = jpeg_std_error(&err); jpeg_create_compress(&c); size_t size = 0;
  jpeg_mem_dest(&c, out, max, &size); c.image_width = y.Width(); c.image_height = y.Height(); c.input_components = 3; c.in_color_space = JCS_YCbCr;
  jpeg_set_defaults(&c); jpeg_set_quality(&c, 75, TRUE); jpeg_start_compress(&c, TRUE);
  byte* row = new byte[3 * y.Width()];
  while (c.next_scanline < c.image_height) { for (int x = 0; x < y.Width(); x++) { row[3*x] = y.Pixel(x, c.next_scanline); row[3*x+1] = cb.Pixel(x, c.next_scanline); row[3*x+2] = cr.Pixel(x, c.next_scanline); } JSAMPROW r[1]; r[0] = row; jpeg_write_scanlines(&c, r, 1); }
  delete[] row; jpeg_finish_compress(&c); jpeg_destroy_compress(&c); return size;
}
void Web::Img(const ONotifyEvent& e) { static byte buf[65536]; size_t n = Convert((OFbkImageVectorData*)e.Data(0), buf, sizeof buf); OSYSPRINT(("jpeg %d %02x%02x\n", n > 500, buf[0], buf[1])); FILE* f = fopen("/MS/P.JPG", "wb"); fwrite(buf, 1, n, f); fclose(f); observer[0]->AssertReady(); }
