// The one translation unit that holds the loader's function pointers.
#define VOLK_IMPLEMENTATION
#include <volk.h>
