#ifndef VX_COUNTERS_ACCESS_GLSL
#define VX_COUNTERS_ACCESS_GLSL

#include "shared/counters.h"

layout(scalar) buffer Counters {
    uint counters[];
};

void count(uint what, uint amount) {
    if (amount > 0u) atomicAdd(counters[what], amount);
}

#endif
