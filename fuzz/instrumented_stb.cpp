// The image decoder, compiled with the fuzzer's instrumentation: the library of the system has none.
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
