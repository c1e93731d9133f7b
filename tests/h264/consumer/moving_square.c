/* The same square as a byte stream, from C.
 * In: the file's name. Out: 100 pictures of 320x180 pixels, 25 a second. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "h264/h264.h"

enum { width_px = 320, height_px = 180, pictures = 100 };

static uint8_t luma[height_px][width_px];
static uint8_t chroma[height_px / 2][width_px / 2];

static void fill(const piblocks_h264_rect* rect, int value) {
  for (int y = rect->y_px; y < rect->y_px + rect->height_px; ++y)
    memset(&luma[y][rect->x_px], value, (size_t)rect->width_px);
}

static int write_film(piblocks_h264_encoder* encoder, uint8_t* unit, size_t room, FILE* file) {
  const piblocks_h264_plane planes[3] = {
      {luma[0], width_px}, {chroma[0], width_px / 2}, {chroma[0], width_px / 2}};
  piblocks_h264_rect changed[2] = {{0, 0, 0, 0}, {0, 0, 0, 0}}; /* the square: before, and now */
  size_t size = piblocks_h264_headers(encoder, unit, room);
  memset(luma, 128, sizeof luma);
  memset(chroma, 128, sizeof chroma);
  for (int i = 0; size != 0 && i < pictures; ++i) {
    if (fwrite(unit, 1, size, file) != size) return 0;
    changed[0] = changed[1];
    changed[1] = (piblocks_h264_rect){2 * i, 60, 64, 64};
    fill(&changed[0], 128);
    fill(&changed[1], 235);
    size = piblocks_h264_encode(encoder, planes, changed, 2, i % 50 == 0, unit, room);
  }
  return size != 0 && fwrite(unit, 1, size, file) == size;
}

int main(int count, char** arguments) {
  if (count != 2) return 2;
  piblocks_h264_config config = piblocks_h264_default_config(width_px, height_px);
  config.rate_numerator = 25;
  char message[200];
  piblocks_h264_encoder* encoder = piblocks_h264_open(&config, message, sizeof message);
  if (!encoder) return fprintf(stderr, "%s\n", message), 1;
  const size_t room = piblocks_h264_max_unit_bytes(&config);
  uint8_t* unit = malloc(room);
  FILE* file = fopen(arguments[1], "wb");
  int done = unit && file && write_film(encoder, unit, room, file);
  if (!done) fprintf(stderr, "%s: %s\n", arguments[1], piblocks_h264_problem(encoder));
  if (file && fclose(file) != 0) done = 0;
  free(unit);
  piblocks_h264_close(encoder);
  return done ? 0 : 1;
}
