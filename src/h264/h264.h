/* The H.264 encoder of encoder.hpp, for C and for languages that call C.
 * In: pictures in 4:2:0, and the rectangles of each that may have changed. Out: access units of a
 * byte stream, in buffers of the caller. No function lets an exception out. */
#ifndef PIBLOCKS_H264_H
#define PIBLOCKS_H264_H

/* NOLINTBEGIN(modernize-*,readability-identifier-naming,cppcoreguidelines-avoid-c-arrays): C */
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Config of encoder.hpp, which says what each field may be. */
typedef struct piblocks_h264_config {
  int width_px;
  int height_px;
  int64_t rate_numerator;
  int64_t rate_denominator;
  int qp;
  int level_idc;
} piblocks_h264_config;

typedef struct piblocks_h264_plane {
  const uint8_t* samples;
  ptrdiff_t stride_bytes;
} piblocks_h264_plane;

typedef struct piblocks_h264_rect {
  int x_px;
  int y_px;
  int width_px;
  int height_px;
} piblocks_h264_rect;

typedef struct piblocks_h264_encoder piblocks_h264_encoder;

/* A config for pictures of this size: 60 pictures a second, and the defaults of encoder.hpp. */
piblocks_h264_config piblocks_h264_default_config(int width_px, int height_px);

/* The most bytes that headers or an access unit of such a stream can have; 0 if there can be no
 * such stream. */
size_t piblocks_h264_max_unit_bytes(const piblocks_h264_config* config);

/* Null if it fails; the reason is then in message, cut off to message_bytes with its final zero. */
piblocks_h264_encoder* piblocks_h264_open(const piblocks_h264_config* config, char* message,
                                          size_t message_bytes);
/* Takes null too. */
void piblocks_h264_close(piblocks_h264_encoder* encoder);

/* Both write to `unit`, which has room for piblocks_h264_max_unit_bytes(), and return the number of
 * bytes; 0 if they fail, and piblocks_h264_problem() says why. A picture that there may be no room
 * for is refused before it is encoded: the stream stays as it was. */
size_t piblocks_h264_headers(piblocks_h264_encoder* encoder, uint8_t* unit, size_t unit_bytes);
/* planes: Y, Cb, Cr. changed: as many rectangles as `rects` says. is_idr: not 0 for a picture that
 * depends on no other. */
size_t piblocks_h264_encode(piblocks_h264_encoder* encoder, const piblocks_h264_plane planes[3],
                            const piblocks_h264_rect* changed, size_t rects, int is_idr,
                            uint8_t* unit, size_t unit_bytes);
/* Why the last function that failed did so; empty if none has. Lives until the next call. */
const char* piblocks_h264_problem(const piblocks_h264_encoder* encoder);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(modernize-*,readability-identifier-naming,cppcoreguidelines-avoid-c-arrays) */

#endif
