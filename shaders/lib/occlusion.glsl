// Occlusion rays off a hit.
#ifndef VX_OCCLUSION_GLSL
#define VX_OCCLUSION_GLSL

#include "lib/constants.glsl"
#include "lib/surface.glsl"

VX_SPECIALIZED(uint, ao_rays, 1u);  // per pixel and sample

// Index of the next ray, 64 bits, when each of the `takes` samples so far took `rays`.
uvec2 first_ray(uint takes, uint rays) {
    uvec2 first;
    umulExtended(takes, rays, first.y, first.x);
    return first;
}

uvec2 ray_number(uvec2 first, uint i) {
    uint low = first.x + i;
    return uvec2(low, first.y + (low < i ? 1u : 0u));
}

// Sample point of a ray, by its index in the pixel's stream.
vec2 occlusion_point(uint stream, uvec2 number) {
    return draw_2d(sample_key(stream, number, frame.seed), kPairOcclusion);
}

// A cosine-distributed direction about a hit's normal.
vec3 cosine_off(Hit hit, vec2 u) {
    return is_on_sphere(hit) ? cosine_about(surface_normal(hit), u) : cosine_on_face(hit.face, u);
}

// Fraction of a pixel's cosine-distributed rays that meet nothing within the radius; `first` is the index of
// the first ray in the pixel's stream.
float trace_visibility(Pixel pixel, Hit hit, uvec2 first) {
    uint own = own_sphere(hit);
    uint stream = pixel_stream(pixel);
    uint open = 0u;
    for (uint i = 0u; i < ao_rays; ++i) {
        vec3 direction = cosine_off(hit, occlusion_point(stream, ray_number(first, i)));
        open += is_occluded(ray_from(hit, direction, frame.ao_radius), own) ? 0u : 1u;
    }
    return float(open) / float(ao_rays);
}

#endif
