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

// The product of the shares that the list's spheres leave, in its order, found by the hierarchy: one walk for each sphere
// that takes of the discs, and one that finds no more.
vec2 product_by_tree(uint own, vec3 point, vec3 normal, vec2 radii) {
    vec2 shares = vec2(1.0);
    vec2 next_shares = vec2(1.0);
    uint next = kNoSphere;
    uint first = 0u;  // the spheres before have been multiplied
    BoxQuery query = point_query(point, max(radii.x, radii.y));
    SphereWalk walk = begin_walk(query);
    while (walk.group != 0u) {
        SphereNode node = load_sphere_node(node_of(walk, query));
        bool is_leaf = is_sphere_leaf(node);
        uint number = leaf_number(node);
        vec2 left = shares_left(leaf_sphere(node), number, own, point, normal, radii);
        bool is_next = is_leaf && number >= first && number < next && min(left.x, left.y) < 1.0;
        next = is_next ? number : next;
        next_shares = is_next ? left : next_shares;
        walk = walk_on(walk, is_leaf ? 0u : children_met(node, query, 0.0));
        if (walk.group == 0u && next != kNoSphere) {
            shares *= next_shares;
            first = next + 1u;
            next = kNoSphere;
            walk = begin_walk(query);
        }
    }
    count(kFaultLoopCut, are_loops_spent(2u + (first & 1u)) ? 1u : 0u);
    return shares;
}

// The product of all shares of two discs. A sphere takes from a disc only where it comes within the disc's radius.
vec2 product_of_shares(uint own, vec3 point, vec3 normal, vec2 radii) {
    if (has_sphere_tree) return product_by_tree(own, point, normal, radii);
    vec2 shares = vec2(1.0);
    for (uint i = 0u; i < sphere_count; ++i)
        shares *= shares_left(sphere_table[i].shape, i, own, point, normal, radii);
    return shares;
}

// The uncovered fractions of a hit's two kernels, in [kMinShare, 1].
vec2 disc_shares(Hit hit, vec2 radii) {
    if (sphere_count == 0u || photon_surface(hit) == kNoSurface) return vec2(1.0);
    uint own = hit.face >= kFaceSphere ? hit.sphere : kNoSurface;
    return max(product_of_shares(own, photon_position(hit), disc_normal(hit), radii), vec2(kMinShare));
}

#endif
