// The sample sequence of a frame. It is a specialization constant: on lavapipe, a branch on a member of a
// uniform block either runs both sides or is compiled anew for each sample.
#ifndef VX_SAMPLES_GLSL
#define VX_SAMPLES_GLSL

#include "lib/constants.glsl"
#include "lib/frame_access.glsl"
#include "lib/projection.glsl"
#include "lib/world_access.glsl"
#include "shared/camera.h"

VX_SPECIALIZED(uint, sequence, 0u);  // a kSequence* id

vec2 draw_2d(SampleKey key, uint dimension_pair) {
    return sample_2d(sequence, key, dimension_pair);
}

float draw_1d(SampleKey key, uint dimension) {
    return sample_1d(sequence, key, dimension);
}

// The sample stream of a pixel.
uint pixel_stream(Pixel pixel) {
    return pixel.y * frame.width + pixel.x;
}

// The key of the frame's sample of a pixel.
SampleKey pixel_key(Pixel pixel) {
    return sample_key(pixel_stream(pixel), uvec2(frame.sample_index, 0u), frame.seed);
}

// The camera ray of the frame's sample through a pixel.
Ray camera_ray_of(Pixel pixel) {
    return camera_ray(frame, projection, sequence, pixel.x, pixel.y);
}

#endif
