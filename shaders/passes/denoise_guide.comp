#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Sums the guides of the denoiser (shared/denoise.h) for one half of the film: of the shaded surface its
// normal, the distance of its plane from the camera along the normal (the same all over a voxel face) and its
// albedo as seen by the camera; and the noise-free part of the light, from misses, emitters and the sun.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/counters_access.glsl"
#include "lib/film_group.glsl"
#include "lib/film_sums.glsl"

#include "lib/black_hit.glsl"

VX_SPECIALIZED(uint, has_specular, 1u);
VX_SPECIALIZED(uint, has_rough, 0u);
VX_SPECIALIZED(uint, sums_coverage, 0u);

layout(rgba32ui) readonly uniform uimageBuffer FirstHits;
VX_SUMS(GuideSharp);
VX_SUMS(GuideAlbedo);
VX_SUMS(GuideNormal);
VX_SUMS(GuideOffset);
layout(push_constant, scalar) uniform Push {
    FilmAddPush push;
};

#include "lib/film_cover.glsl"

// radiance() without the light found by random sampling.
vec3 sharp_radiance(Group group, uint k) {
    if (is_surface(group.hits[k])) {
        group.direct[k] = vec3(0.0);
        group.photons[k] = vec3(0.0);
        group.sky[k] = vec3(0.0);
    }
    return radiance(group, k);
}

// The distance of a plane from the camera, along its normal, voxels. A sphere has that of its tangent plane at the
// anchor: one number for all of it, because the distances of its tangent planes differ by more than planes do.
float guide_offset(Hit hit, vec3 normal) {
    if (is_on_sphere(hit)) {
        Sphere shape = spheres[hit.sphere].shape;
        return dot(shape.normal, (shape.anchor - vec3(frame.camera_cell)) - frame.camera_fraction);
    }
    return dot(normal, vec3(hit.cell - frame.camera_cell) + (hit.fraction - frame.camera_fraction));
}

void main() {
    uint at = linear_id();
    uint skipped = push.first_pixel % kGroupPixels;
    if (kGroupPixels * at >= skipped + push.pixel_count) return;
    uint film_group = push.first_pixel / kGroupPixels + at;
    Group group = load_group(at, skipped, skipped + push.pixel_count);
    vec3 sharp[kGroupPixels];
    vec3 albedo[kGroupPixels];
    vec3 normal[kGroupPixels];
    vec4 offset = vec4(0.0);
    for (uint k = 0u; k < kGroupPixels; ++k) {
        Hit hit = group.hits[k];
        if (has_rough != 0u) hit = true_hit(hit);
        bool has_normal = is_surface(hit) && hit.face != kFaceInside;
        sharp[k] = group.inside[k] ? sharp_radiance(group, k) : vec3(0.0);
        albedo[k] = is_surface(hit) ? group.albedo[k] * group.weights[k] : vec3(0.0);
        normal[k] = has_normal ? surface_normal(hit) : vec3(0.0);
        offset[k] = has_normal ? guide_offset(hit, normal[k]) : 0.0;
    }
    if (sums_coverage != 0u) cover(at, group, sharp);
    VX_ADD_VECTORS(GuideSharp, film_group, add_pair, sharp);
    VX_ADD_VECTORS(GuideAlbedo, film_group, add_pair, albedo);
    VX_ADD_VECTORS(GuideNormal, film_group, add_pair, normal);
    VX_ADD_FLOATS(GuideOffset, film_group, add_pair, offset);
    count(kFaultFilmClamped, clamped);
    count(kFaultFilmNonFinite, non_finite);
}
