#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Sunlight that reaches each hit, as a fraction of the irradiance on a surface that faces the sun: visibility
// of a random point of the sun's disc times the cosine. 0 for misses.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/hits.glsl"
#include "lib/surface.glsl"

layout(scalar) writeonly buffer Sun {
    float sun[];
};

void main() {
    init_scene();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = load_hit(pixel.index);
    float lit = 0.0;
    bool traced = false;
    if (is_surface(hit) && hit.face != kFaceInside) {
        SampleKey key = pixel_key(pixel);
        vec2 u = draw_2d(key, kPairSun);
        vec3 direction = uniform_cone(frame.sun_direction, frame.sun_cone_height, u);
        float cosine = dot(surface_normal(hit), direction);
        traced = cosine > 0.0;
        uint own = own_sphere(hit);
        if (traced && !is_occluded(ray_from(hit, direction, kUnbounded), own)) lit = cosine;
    }
    count(kWorkSunRays, traced ? 1u : 0u);
    sun[pixel.index] = lit;
}
