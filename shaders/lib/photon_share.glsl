// The fraction of a visible point's kernel that other spheres do not cover. Include lib/frame_access.glsl and
// lib/photon_frame.glsl first.
#ifndef VX_PHOTON_SHARE_GLSL
#define VX_PHOTON_SHARE_GLSL

#include "lib/constants.glsl"
#include "lib/counters_access.glsl"
#include "lib/loops.glsl"
#include "lib/sphere_tree.glsl"
#include "lib/spheres.glsl"
#include "shared/sampling.h"
#include "shared/photon_area.h"

vec3 disc_normal(Hit hit) {
    if (hit.face < kFaceSphere) return face_normal(hit.face);
    Sphere shape = spheres[hit.sphere].shape;
    return normalize(shape.normal + shape.curvature * (photon_position(hit) - shape.anchor));
}

// Fractions of two concentric discs that one sphere leaves uncovered. The first `glass_spheres` let light
// through.
vec2 shares_left(Sphere shape, uint i, uint own, vec3 point, vec3 normal, vec2 radii) {
    if (i == own || i < glass_spheres) return vec2(1.0);
    return vec2(1.0 - share_taken(shape, point, normal, radii.x), 1.0 - share_taken(shape, point, normal, radii.y));
}

// The product of these fractions over all spheres. A sphere covers a disc only where it comes within the
// disc's radius.
vec2 product_of_shares(uint own, vec3 point, vec3 normal, vec2 radii) {
    vec2 shares = vec2(1.0);
    if (!has_sphere_tree) {
        for (uint i = 0u; i < sphere_count; ++i)
            shares *= shares_left(sphere_table[i].shape, i, own, point, normal, radii);
        return shares;
    }
    BoxQuery query = point_query(point, max(radii.x, radii.y));
    SphereWalk walk = begin_walk(query);
    while (walk.group != 0u) {
        SphereNode node = load_sphere_node(node_of(walk, query));
        bool is_leaf = is_sphere_leaf(node);
        vec2 left = shares_left(leaf_sphere(node), leaf_number(node), own, point, normal, radii);
        shares *= is_leaf ? left : vec2(1.0);
        walk = walk_on(walk, is_leaf ? 0u : children_met(node, query, 0.0));
    }
    count(kFaultLoopCut, are_loops_spent(2u + (walk.group & 1u)) ? 1u : 0u);
    return shares;
}

// The uncovered fractions of a hit's two kernels, in [kMinShare, 1].
vec2 disc_shares(Hit hit, vec2 radii) {
    if (sphere_count == 0u || photon_surface(hit) == kNoSurface) return vec2(1.0);
    uint own = hit.face >= kFaceSphere ? hit.sphere : kNoSurface;
    return max(product_of_shares(own, photon_position(hit), disc_normal(hit), radii), vec2(kMinShare));
}

#endif
