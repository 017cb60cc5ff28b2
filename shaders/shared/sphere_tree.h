// The walk of a bounding volume hierarchy over spheres (sphere_node.h). Children of a node follow one another
// and are visited in the order of the signs of the ray's direction. What a node leaves to be visited waits on
// a stack that is moved as a whole, so it stays in registers, and a walk is one flat loop.
//
// The including side defines VX_SPHERES_PARAM, VX_SPHERES_ARG and load_sphere_node().
#ifndef VX_SPHERE_TREE_H
#define VX_SPHERE_TREE_H

#include "sphere_node.h"

VX_BEGIN

// A place in a walk: the children of a node that are left to be visited, as children_met() gives them, and
// those of the nodes above.
struct SphereWalk {
    uint group;  // 0: the walk has ended
    uint waiting[kTreeStack];
};

struct NearestSphere {
    uint i;  // kNoSphere: none before t
    float t;
    uint steps;  // visited nodes
};

// The smallest glass sphere around a point.
struct EnclosingSphere {
    uint i;  // kNoSphere: in none
    float curvature;
    uint steps;
};

// A walk that begins at node 0.
VX_FN SphereWalk begin_walk(BoxQuery query) {
    SphereWalk walk;
    walk.group = 1u << query.octant;
    for (uint k = 0u; k < kTreeStack; ++k)
        walk.waiting[k] = 0u;
    return walk;
}

// The node that is visited next.
VX_FN uint node_of(SphereWalk walk, BoxQuery query) {
    uint bits = walk.group & 255u;
    uint lowest = (floatBitsToUint(float(int(bits & (0u - bits)))) >> 23u) - 127u;
    return (walk.group >> 8u) + (lowest ^ query.octant);
}

// Goes on from the node that was visited to the children of it that were met.
VX_FN SphereWalk walk_on(SphereWalk walk, uint met) {
    uint bits = walk.group & 255u;
    uint rest = bits & (bits - 1u);
    uint left = rest != 0u ? (walk.group & 0xFFFFFF00u) | rest : 0u;
    bool pushes = met != 0u && left != 0u;
    bool pops = met == 0u && left == 0u;
    SphereWalk next;
    next.group = met != 0u ? met : (pops ? walk.waiting[0] : left);
    for (uint k = 0u; k < kTreeStack; ++k) {
        uint above = k == 0u ? left : walk.waiting[k - 1u];
        uint below = k + 1u < kTreeStack ? walk.waiting[k + 1u] : 0u;
        next.waiting[k] = pushes ? above : (pops ? below : walk.waiting[k]);
    }
    return next;
}

// The first sphere that a ray crosses before t_max, of equal times that of the smallest number; of a ray that
// `takes_any`, one that it crosses. `own` is the sphere that the ray starts on.
VX_FN NearestSphere nearest_in_tree(VX_SPHERES_PARAM vec3 origin, vec3 direction, float t_max, uint own,
                                    bool takes_any) {
    NearestSphere nearest;
    nearest.i = kNoSphere;
    nearest.t = t_max;
    nearest.steps = 0u;
    const BoxQuery query = box_query(origin, direction, 0.0f);
    SphereWalk walk = begin_walk(query);
    while (walk.group != 0u) {
        SphereNode node = load_sphere_node(VX_SPHERES_ARG node_of(walk, query));
        const bool is_leaf = is_sphere_leaf(node);
        const uint number = leaf_number(node);
        const float t = sphere_time(leaf_sphere(node), origin, direction, t_max, number == own);
        const bool is_first =
            is_leaf && (t < nearest.t || (t == nearest.t && t < t_max && number < nearest.i));
        nearest.i = is_first ? number : nearest.i;
        nearest.t = is_first ? t : nearest.t;
        ++nearest.steps;
        walk = walk_on(walk, is_leaf ? 0u : children_met(node, query, nearest.t));
        walk.group = takes_any && nearest.i != kNoSphere ? 0u : walk.group;
    }
    return nearest;
}

// The smallest of the first `glass_count` spheres around a point, other than `but`; of equal ones the one
// with the higher index.
VX_FN EnclosingSphere enclosing_in_tree(VX_SPHERES_PARAM vec3 point, uint glass_count, uint but) {
    EnclosingSphere around;
    around.i = kNoSphere;
    around.curvature = 0.0f;
    around.steps = 0u;
    const BoxQuery query = point_query(point, 0.0f);
    SphereWalk walk = begin_walk(query);
    while (walk.group != 0u) {
        SphereNode node = load_sphere_node(VX_SPHERES_ARG node_of(walk, query));
        const bool is_leaf = is_sphere_leaf(node);
        const uint number = leaf_number(node);
        const Sphere sphere = leaf_sphere(node);
        const bool is_smaller =
            sphere.curvature > around.curvature ||
            (sphere.curvature == around.curvature && (around.i == kNoSphere || number > around.i));
        const bool is_inner =
            is_leaf && number < glass_count && number != but && is_smaller && is_in_sphere(sphere, point);
        around.i = is_inner ? number : around.i;
        around.curvature = is_inner ? sphere.curvature : around.curvature;
        ++around.steps;
        walk = walk_on(walk, is_leaf ? 0u : children_met(node, query, 0.0f));
    }
    return around;
}

VX_END

#endif
