// Planes of the denoiser: a texel of four floats per pixel, row by row.
#ifndef VX_DENOISE_PLANES_GLSL
#define VX_DENOISE_PLANES_GLSL

#include "lib/constants.glsl"
#include "shared/denoise.h"

layout(push_constant, scalar) uniform Push {
    DenoisePush push;
};

#define VX_INPUT(name) layout(rgba32ui) readonly uniform uimageBuffer name
#define VX_OUTPUT(name) layout(rgba32ui) writeonly uniform uimageBuffer name
#define VX_LOAD(name, at) uintBitsToFloat(imageLoad(name, at))
#define VX_STORE(name, at, value) imageStore(name, at, floatBitsToUint(value))

ivec2 this_place() {
    return ivec2(gl_GlobalInvocationID.xy);
}

bool is_inside(ivec2 place) {
    return place.x >= 0 && place.y >= 0 && place.x < push.size.x && place.y < push.size.y;
}

int texel_at(ivec2 place) {
    return place.y * push.size.x + place.x;
}

#endif
