// The share of a visible point's disc that other spheres leave. Include lib/frame_access.glsl and
// lib/photon_frame.glsl first.
#ifndef VX_PHOTON_SHARE_GLSL
#define VX_PHOTON_SHARE_GLSL

#include "lib/spheres.glsl"

#include "lib/constants.glsl"
#include "shared/sampling.h"
#include "shared/photon_area.h"

vec3 disc_normal(Hit hit) {
    if (hit.face < kFaceSphere) return face_normal(hit.face);
    Sphere shape = spheres[hit.sphere].shape;
    return normalize(shape.normal + shape.curvature * (photon_position(hit) - shape.anchor));
}

// Shares of the discs of a common centre and two radii that one sphere leaves. Light goes through the first spheres.
vec2 shares_left(Sphere shape, uint i, uint own, vec3 point, vec3 normal, vec2 radii) {
    if (i == own || i < glass_spheres) return vec2(1.0);
    return vec2(1.0 - share_taken(shape, point, normal, radii.x), 1.0 - share_taken(shape, point, normal, radii.y));
}

// The shares of a hit's two discs, in [kMinShare, 1].
vec2 disc_shares(Hit hit, vec2 radii) {
    vec2 shares = vec2(1.0);
    if (sphere_count == 0u || photon_surface(hit) == kNoSurface) return shares;
    uint own = hit.face >= kFaceSphere ? hit.sphere : kNoSurface;
    vec3 normal = disc_normal(hit);
    vec3 point = photon_position(hit);
    if (sphere_count <= kFewSpheres) {
        for (uint i = 0u; i < sphere_count; ++i)
            shares *= shares_left(sphere_table[i].shape, i, own, point, normal, radii);
    } else {
        for (uint i = 0u; i < sphere_count; ++i)
            shares *= shares_left(spheres[i].shape, i, own, point, normal, radii);
    }
    return max(shares, vec2(kMinShare));
}

#endif
