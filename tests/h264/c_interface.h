/* A program in C that encodes a few pictures, as c_interface_test.cpp calls it. */
#ifndef PIBLOCKS_TESTS_C_INTERFACE_H
#define PIBLOCKS_TESTS_C_INTERFACE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Headers and three pictures in which a square moves.
 * @return the bytes of the stream, which the caller frees; their number is in stream_bytes. Null if
 *         anything fails. */
uint8_t* encode_in_c(int width_px, int height_px, size_t* stream_bytes);

#ifdef __cplusplus
}
#endif

#endif
