// The analytic spheres. How many there are is a constant of the pipeline: lavapipe would compile a loop up to a value of a
// uniform block anew for each dispatch.
#ifndef VX_SPHERES_GLSL
#define VX_SPHERES_GLSL

#include "shared/gpu_types.h"
#include "shared/limits.h"

layout(constant_id = 1) const uint sphere_count = 0u;
layout(constant_id = 12) const uint glass_spheres = 0u;  // the first so many spheres have glass

layout(scalar) readonly buffer Spheres {
    uint64_t sphere_words[];  // four of a record
};

// A sphere by its number. Lavapipe loads for one invocation after the other, so two words at a time.
SphereRecord sphere_record(uint i) {
    vec2 a = uintBitsToFloat(unpack32(sphere_words[4u * i]));
    vec2 b = uintBitsToFloat(unpack32(sphere_words[4u * i + 1u]));
    vec2 c = uintBitsToFloat(unpack32(sphere_words[4u * i + 2u]));
    uvec2 d = unpack32(sphere_words[4u * i + 3u]);
    SphereRecord record;
    record.shape.anchor = vec3(a, b.x);
    record.shape.curvature = b.y;
    record.shape.normal = vec3(c, uintBitsToFloat(d.x));
    record.material = d.y;
    return record;
}

// A few spheres are tested in an unrolled loop over constant places of an array.
layout(scalar) uniform SphereTable {
    SphereRecord sphere_table[kFewSpheres];
};

SphereRecord held_spheres[kFewSpheres];

// Takes the few spheres once. Lavapipe loads from a uniform block for each invocation apart, even from constant places,
// and again in every turn of a loop: three quarters of a test of a sphere would be loads.
void hold_spheres() {
    for (uint i = 0u; i < kFewSpheres; ++i)
        held_spheres[i] = sphere_table[i];
}

#endif
