// The share of a visible point's disc that other spheres leave. Include lib/frame_access.glsl and
// lib/photon_frame.glsl first.
#ifndef VX_PHOTON_SHARE_GLSL
#define VX_PHOTON_SHARE_GLSL

#include "shared/sampling.h"
#include "shared/photon_area.h"

layout(constant_id = 1) const uint has_spheres = 0u;
layout(constant_id = 31) const uint clips_discs = 1u;

layout(scalar) readonly buffer Spheres {
    SphereRecord spheres[];
};

vec3 disc_normal(Hit hit) {
    if (hit.face < kFaceSphere) return face_normal(hit.face);
    Sphere shape = spheres[hit.sphere].shape;
    return normalize(shape.normal + shape.curvature * (photon_position(hit) - shape.anchor));
}

// In [kLeastShare, 1]. Unit normals of either side will do.
float disc_share(Hit hit, float radius) {
    if (has_spheres == 0u || clips_discs == 0u || photon_surface(hit) == kNoSurface) return 1.0;
    uint own = hit.face >= kFaceSphere ? hit.sphere : kNoSurface;
    vec3 normal = disc_normal(hit);
    vec3 point = photon_position(hit);
    float share = 1.0;
    for (uint i = frame.glass_spheres; i < frame.sphere_count; ++i) {  // light goes through the first ones
        float taken = share_taken(spheres[i].shape, point, normal, radius);
        share *= i == own ? 1.0 : 1.0 - taken;
    }
    return max(share, kLeastShare);
}

#endif
