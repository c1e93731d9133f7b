// The conversion of src/media/pixels/yuv420.cpp once more, compiled without vector instructions.
#define convert_to_yuv420 convert_to_yuv420_scalar
#define chroma_aligned chroma_aligned_scalar
#include "media/pixels/yuv420.cpp"
