// Occlusion rays off a hit.
#ifndef VX_OCCLUSION_GLSL
#define VX_OCCLUSION_GLSL

#include "lib/constants.glsl"
#include "lib/surface.glsl"

VX_SPECIALIZED(uint, ao_rays, 1u);  // of a pixel and sample

// Number of a ray, 64 bits, when each of `takes` samples before took `rays`.
uvec2 first_ray(uint takes, uint rays) {
    uvec2 first;
    umulExtended(takes, rays, first.y, first.x);
    return first;
}

uvec2 ray_number(uvec2 first, uint i) {
    uint low = first.x + i;
    return uvec2(low, first.y + (low < i ? 1u : 0u));
}

// Where a ray takes its direction from, by its number in the pixel's stream.
vec2 occlusion_point(uint stream, uvec2 number) {
    return draw_2d(sample_key(stream, number, frame.seed), kPairOcclusion);
}

// Cosine-distributed off a hit.
vec3 cosine_off(Hit hit, vec2 u) {
    return is_on_sphere(hit) ? cosine_about(surface_normal(hit), u) : cosine_on_face(hit.face, u);
}

// Share of a pixel's cosine-weighted rays off its hit that meet nothing within the radius; `first` numbers the
// first of them in the pixel's stream.
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
