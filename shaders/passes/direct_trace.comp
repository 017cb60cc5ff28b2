#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Light that reaches each hit directly from emitters: their mean radiance over the cosine-weighted
// hemisphere, irradiance / pi. One ray goes to an emitter selected by power, and one in the direction of a
// diffuse reflection unless paths trace it; the balance heuristic weighs them. Source: Veach and Guibas 1995.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/hits.glsl"
#include "lib/path.glsl"

#include "lib/lights.glsl"

layout(scalar) writeonly buffer Direct {
    vec3 direct[];
};

VX_SPECIALIZED(uint, rays, 2u);  // 1: paths trace the second one

void main() {
    init_scene();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = load_hit(pixel.index);
    vec3 light = vec3(0.0);
    uint traced_rays = 0u;
    if (is_surface(hit) && hit.face != kFaceInside) {
        SampleKey key = pixel_key(pixel);
        vec3 normal = surface_normal(hit);
        vec3 origin = local_position(hit.cell, hit.fraction);
        vec2 u_emitter = draw_2d(key, kPairEmitterPoint);
        vec2 u_surface = draw_2d(key, kPairSurface);
        uint bits = unit_bits(draw_1d(key, 2u * kPairEmitter));
        LightSample aim = aim_at_emitter(origin, bits, sample_1d(kSequenceWhite, key, 2u * kPairEmitter + 1u), u_emitter);
        for (uint i = 0u; i < rays; ++i) {
            vec3 direction = i == 0u ? aim.direction : cosine_about(normal, u_surface);
            float cosine = dot(normal, direction);
            bool traced = cosine > 0.0 && (i == 1u || aim.pdf > 0.0);
            if (!traced) continue;
            ++traced_rays;
            Hit met = next_hit(path_from(hit, direction)).hit;
            if (!is_surface(met) || (i == 0u && !is_on_emitter(met, aim.emitter))) continue;
            vec3 emission = material_emission(met.material);
            float emitter_pdf = light_pdf(origin, direction, met, emission);
            if (emitter_pdf == 0.0) continue;
            float surface_pdf = cosine * kInversePi;
            float weight = i == 0u ? balance_weight(emitter_pdf, surface_pdf) : balance_weight(surface_pdf, emitter_pdf);
            light += emission * (weight * (i == 0u ? surface_pdf / aim.pdf : 1.0));
        }
    }
    count(kWorkPathSegments, traced_rays);
    direct[pixel.index] = light;
}
