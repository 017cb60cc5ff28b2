// A bounding volume hierarchy over spheres, its nodes in depth-first order: a ray that hits a box continues
// with the next node, one that misses it with the node after all that the box contains. So a traversal needs
// no stack and is one flat loop.
//
// The including file defines VX_SPHERES_PARAM, VX_SPHERES_ARG, load_sphere_node() and load_sphere().
#ifndef VX_SPHERE_TREE_H
#define VX_SPHERE_TREE_H

#include "gpu_types.h"
#include "limits.h"
#include "sphere.h"

VX_BEGIN

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

// Bound of the rounding errors of sphere_time() and is_in_sphere() for spheres in this box, seen from the
// origin.
VX_FN vec3 node_slack(vec3 low, vec3 high) {
    vec3 reach = max(abs(low), abs(high));
    return vec3(kSphereSlack * max(reach.x, max(reach.y, reach.z)));
}

// 1 / direction, finite, so that no product with it is 0 * infinity.
VX_FN vec3 slab_scale(vec3 direction) {
    return vec3(1.0f / (abs(direction.x) < kLeastSlope ? kLeastSlope : direction.x),
                1.0f / (abs(direction.y) < kLeastSlope ? kLeastSlope : direction.y),
                1.0f / (abs(direction.z) < kLeastSlope ? kLeastSlope : direction.z));
}

// Whether a ray may hit a sphere in the box of the node at a t in [0, t_max].
VX_FN bool is_node_met(SphereNode node, vec3 origin, vec3 scale, float t_max) {
    vec3 low = node.low - origin;
    vec3 high = node.high - origin;
    vec3 slack = node_slack(low, high);
    vec3 a = (low - slack) * scale;
    vec3 b = (high + slack) * scale;
    vec3 first = min(a, b);
    vec3 last = max(a, b);
    float enters = max(max(first.x, first.y), max(first.z, 0.0f));
    float leaves = min(min(last.x, last.y), min(last.z, t_max));
    return enters <= leaves;
}

// Whether a sphere in the box of the node may come within a radius of a point.
VX_FN bool is_node_near(SphereNode node, vec3 point, float radius) {
    vec3 low = node.low - point;
    vec3 high = node.high - point;
    vec3 slack = node_slack(low, high) + vec3(radius);
    vec3 beyond = max(low - slack, -high - slack);
    return max(beyond.x, max(beyond.y, beyond.z)) <= 0.0f;
}

// The first sphere that a ray crosses before t_max; at equal t the one with the smallest index. `own` is the
// sphere on which the ray starts.
VX_FN NearestSphere nearest_in_tree(VX_SPHERES_PARAM uint node_count, vec3 origin, vec3 direction,
                                    float t_max, uint own) {
    NearestSphere nearest;
    nearest.i = kNoSphere;
    nearest.t = t_max;
    nearest.steps = 0u;
    const vec3 scale = slab_scale(direction);
    uint place = 0u;
    while (place < node_count) {
        SphereNode node = load_sphere_node(VX_SPHERES_ARG place);
        const bool is_met = is_node_met(node, origin, scale, nearest.t);
        place = is_met ? place + 1u : node.next;
        ++nearest.steps;
        if (is_met && node.sphere != kNoSphere) {
            const float t = sphere_time(load_sphere(VX_SPHERES_ARG node.sphere), origin, direction, t_max,
                                        node.sphere == own);
            const bool is_first = t < nearest.t || (t == nearest.t && t < t_max && node.sphere < nearest.i);
            nearest.i = is_first ? node.sphere : nearest.i;
            nearest.t = is_first ? t : nearest.t;
        }
    }
    return nearest;
}

// The smallest of the first `glass_count` spheres around a point, other than `but`; of equal ones the one
// with the higher index.
VX_FN EnclosingSphere enclosing_in_tree(VX_SPHERES_PARAM uint node_count, vec3 point, uint glass_count,
                                        uint but) {
    EnclosingSphere around;
    around.i = kNoSphere;
    around.curvature = 0.0f;
    around.steps = 0u;
    uint place = 0u;
    while (place < node_count) {
        SphereNode node = load_sphere_node(VX_SPHERES_ARG place);
        const bool is_met = is_node_met(node, point, vec3(1.0f), 0.0f);
        place = is_met ? place + 1u : node.next;
        ++around.steps;
        if (is_met && node.sphere < glass_count && node.sphere != but) {
            Sphere sphere = load_sphere(VX_SPHERES_ARG node.sphere);
            const bool is_smaller =
                sphere.curvature > around.curvature ||
                (sphere.curvature == around.curvature && (around.i == kNoSphere || node.sphere > around.i));
            const bool is_inner = is_smaller && is_in_sphere(sphere, point);
            around.i = is_inner ? node.sphere : around.i;
            around.curvature = is_inner ? sphere.curvature : around.curvature;
        }
    }
    return around;
}

VX_END

#endif
