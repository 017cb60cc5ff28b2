#ifndef VX_TALLY_ACCESS_GLSL
#define VX_TALLY_ACCESS_GLSL

#include "shared/tally.h"

layout(scalar) buffer Tally {
    uint tally[];
};

void count(uint what, uint amount) {
    if (amount > 0u) atomicAdd(tally[what], amount);
}

#endif
