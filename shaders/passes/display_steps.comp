#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// What each pixel costs, as 8-bit sRGB codes: the steps that its camera ray takes through the structure, and
// those of the shadow ray from its hit to the middle of the sun. No beam shortens the camera ray.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "shared/window.h"

#define VX_PUSH DisplayRangePush range;
#include "lib/frame_access.glsl"
#include "lib/samples.glsl"
#include "lib/world_access.glsl"
#include "shared/false_colour.h"

VX_SPECIALIZED(uint, has_shadows, 0u);
VX_SPECIALIZED(uint, is_bgr, 0u);  // else red is the lowest byte

layout(scalar) writeonly buffer Display {
    uint display[];
};

uint shadow_steps(Ray ray, MarchHit hit) {
    if (has_shadows == 0u || hit.face >= kFaceInside) return 0u;
    float along = frame.sun_direction[hit.face >> 1u];
    if ((hit.face & 1u) != 0u ? along <= 0.0 : along >= 0.0) return 0u;
    Ray shadow = spawn_ray(hit.cell, hit.face, hit_fraction(ray, hit), frame.sun_direction, kUnbounded);
    return march(shadow, frame.chunks).steps;
}

void main() {
    init_world();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    uint steps = 0u;
    WorldEntry entry = enter_world(camera_ray_of(pixel), frame.chunks << kChunkLog2);
    if (entry.enters) {
        MarchHit hit = march(entry.ray, frame.chunks);
        steps = hit.steps + shadow_steps(entry.ray, hit);
    }
    float taken = log(max(float(steps), 1.0)) * 0.43429448;
    vec3 codes = false_colour((taken - range.low) / (range.high - range.low));
    if (is_bgr != 0u) codes = codes.zyx;
    display[pixel.index] = packUnorm4x8(vec4(codes, 1.0));
}
