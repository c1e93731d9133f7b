/* What a user of the library writes in C. */
#include "c_interface.h"

#include <stdlib.h>
#include <string.h>

#include "h264/h264.h"

static void draw(uint8_t* luma, int width_px, int height_px, int x_px) {
  int y;
  memset(luma, 235, (size_t)width_px * (size_t)height_px);
  for (y = 0; y < height_px / 2; ++y) memset(luma + y * width_px + x_px, 16, 8);
}

/* @return 0 if anything fails */
static size_t encode_all(piblocks_h264_encoder* encoder, const piblocks_h264_plane planes[3],
                         uint8_t* luma, int width_px, int height_px, uint8_t* stream, size_t room) {
  size_t size = piblocks_h264_headers(encoder, stream, room);
  int i;
  if (size == 0) return 0;
  for (i = 0; i < 3; ++i) {
    piblocks_h264_rect rects[2];
    size_t unit_bytes;
    rects[0].x_px = 4 * i;
    rects[0].y_px = 0;
    rects[0].width_px = 16;
    rects[0].height_px = height_px / 2;
    rects[1] = rects[0];
    draw(luma, width_px, height_px, 4 * i);
    unit_bytes =
        piblocks_h264_encode(encoder, planes, rects, 2, i == 2, stream + size, room - size);
    if (unit_bytes == 0) return 0;
    size += unit_bytes;
  }
  return size;
}

uint8_t* encode_in_c(int width_px, int height_px, size_t* stream_bytes) {
  const piblocks_h264_config config = piblocks_h264_default_config(width_px, height_px);
  const size_t room = 4 * piblocks_h264_max_unit_bytes(&config);
  const size_t samples = (size_t)width_px * (size_t)height_px;
  piblocks_h264_encoder* encoder = piblocks_h264_open(&config, NULL, 0);
  uint8_t* stream = malloc(room);
  uint8_t* luma = malloc(samples);
  uint8_t* chroma = malloc(samples / 4);
  *stream_bytes = 0;
  if (encoder != NULL && stream != NULL && luma != NULL && chroma != NULL) {
    piblocks_h264_plane planes[3];
    memset(chroma, 128, samples / 4);
    planes[0].samples = luma;
    planes[0].stride_bytes = width_px;
    planes[1].samples = chroma;
    planes[1].stride_bytes = width_px / 2;
    planes[2] = planes[1];
    *stream_bytes = encode_all(encoder, planes, luma, width_px, height_px, stream, room);
  }
  piblocks_h264_close(encoder);
  free(luma);
  free(chroma);
  if (*stream_bytes > 0) return stream;
  free(stream);
  return NULL;
}
