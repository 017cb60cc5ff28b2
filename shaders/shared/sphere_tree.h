// A bounding volume hierarchy over spheres. A node has up to eight children, whose boxes are bytes on a grid
// of its own (Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed
// Wide BVHs"). Children follow one another and are visited in the order of the signs of the ray's direction.
// What a node leaves to be visited waits on a stack that is moved as a whole, so it stays in registers, and a
// walk is one flat loop.
//
// The texels of a node, by words:
//     corner of the grid, number of the first child << 11 | children - 1 << 8 | biased exponent of the grid's
//     step low ends of the children's boxes, x, y and z; then their high ends: a byte each, two words an axis
// The texels of a sphere:
//     anchor, number of the sphere << 8 | kSphereLeaf
//     normal, curvature
//
// The including side defines VX_SPHERES_PARAM, VX_SPHERES_ARG and load_sphere_node().
#ifndef VX_SPHERE_TREE_H
#define VX_SPHERE_TREE_H

#include "gpu_types.h"
#include "limits.h"
#include "sphere.h"

VX_BEGIN

VX_CONST(uint, kTreeWidth, 8u);
// In place of an exponent: that of infinity, which no grid has.
VX_CONST(uint, kSphereLeaf, 255u);
VX_CONST(uint, kMaxTreeNodes, 1u << 21);

// A ray, or the surroundings of a point, that looks for boxes.
struct BoxQuery {
    // Where planes are measured from that a ray enters a box by, and those that it leaves by. They lie apart,
    // by what rounding and the radius add to a box.
    vec3 near_origin;
    vec3 far_origin;
    vec3 scale;   // 1 / direction
    uint octant;  // a bit for each axis that the ray descends
};

// A place in a walk: the children of a node that are left to be visited, as the number of the first child <<
// 8 and a bit for each in the order of the ray, and those of the nodes above.
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

// 1 / direction, finite, so that no product with it is 0 * infinity.
VX_FN vec3 slab_scale(vec3 direction) {
    return vec3(1.0f / (abs(direction.x) < kLeastSlope ? kLeastSlope : direction.x),
                1.0f / (abs(direction.y) < kLeastSlope ? kLeastSlope : direction.y),
                1.0f / (abs(direction.z) < kLeastSlope ? kLeastSlope : direction.z));
}

// Looks for boxes that come within a radius of a ray.
VX_FN BoxQuery box_query(vec3 origin, vec3 direction, float radius) {
    BoxQuery query;
    query.scale = slab_scale(direction);
    float reach = kSphereSlack * max(abs(origin.x), max(abs(origin.y), abs(origin.z))) + radius;
    vec3 wider = vec3(query.scale.x < 0.0f ? -reach : reach, query.scale.y < 0.0f ? -reach : reach,
                      query.scale.z < 0.0f ? -reach : reach);
    query.near_origin = origin + wider;
    query.far_origin = origin - wider;
    query.octant = (query.scale.x < 0.0f ? 1u : 0u) | (query.scale.y < 0.0f ? 2u : 0u) |
                   (query.scale.z < 0.0f ? 4u : 0u);
    return query;
}

// Looks for boxes that come within a radius of a point, with a t_max of 0.
VX_FN BoxQuery point_query(vec3 point, float radius) {
    return box_query(point, vec3(1.0f), radius);
}

VX_FN bool is_sphere_leaf(SphereNode node) {
    return (node.texels[0].w & 255u) == kSphereLeaf;
}

VX_FN uint leaf_number(SphereNode leaf) {
    return leaf.texels[0].w >> 8u;
}

VX_FN Sphere leaf_sphere(SphereNode leaf) {
    Sphere sphere;
    uvec4 a = leaf.texels[0];
    uvec4 b = leaf.texels[1];
    sphere.anchor = vec3(uintBitsToFloat(a.x), uintBitsToFloat(a.y), uintBitsToFloat(a.z));
    sphere.normal = vec3(uintBitsToFloat(b.x), uintBitsToFloat(b.y), uintBitsToFloat(b.z));
    sphere.curvature = uintBitsToFloat(b.w);
    return sphere;
}

// Byte k of a word. By way of int, which lavapipe converts in one instruction.
VX_FN float byte_of(uint word, uint k) {
    return float(int((word >> (8u * k)) & 255u));
}

// The lesser of two numbers that are no NaN: one instruction of lavapipe's, where min() takes several.
VX_FN float lesser(float a, float b) {
    return a < b ? a : b;
}

VX_FN float greater(float a, float b) {
    return a > b ? a : b;
}

// The ends of the boxes of four children along an axis, bytes, as times of a ray.
struct FourSlabs {
    uint near_bytes;
    uint far_bytes;
    float scale;
    float near_at;
    float far_at;
};

VX_FN FourSlabs four_slabs(uint low, uint high, float step, float corner, float scale, float near_origin,
                           float far_origin) {
    FourSlabs slabs;
    slabs.near_bytes = scale < 0.0f ? high : low;
    slabs.far_bytes = scale < 0.0f ? low : high;
    slabs.scale = step * scale;
    slabs.near_at = (corner - near_origin) * scale;
    slabs.far_at = (corner - far_origin) * scale;
    return slabs;
}

VX_FN float slab_enters(FourSlabs slabs, uint k) {
    return byte_of(slabs.near_bytes, k) * slabs.scale + slabs.near_at;
}

VX_FN float slab_leaves(FourSlabs slabs, uint k) {
    return byte_of(slabs.far_bytes, k) * slabs.scale + slabs.far_at;
}

// Of four children of a node, from number 0 or 4 on, those whose boxes a query meets at a time in [0, t_max]:
// a bit for each.
VX_FN uint four_met(FourSlabs x, FourSlabs y, FourSlabs z, float t_max) {
    uint met = 0u;
    for (uint k = 0u; k < 4u; ++k) {
        float enters =
            greater(greater(slab_enters(x, k), slab_enters(y, k)), greater(slab_enters(z, k), 0.0f));
        float leaves = lesser(lesser(slab_leaves(x, k), slab_leaves(y, k)), lesser(slab_leaves(z, k), t_max));
        met |= enters <= leaves ? 1u << k : 0u;
    }
    return met;
}

// Bit k of eight moved to k ^ octant.
VX_FN uint in_order(uint bits, uint octant) {
    bits = (octant & 1u) != 0u ? ((bits & 0x55u) << 1u) | ((bits >> 1u) & 0x55u) : bits;
    bits = (octant & 2u) != 0u ? ((bits & 0x33u) << 2u) | ((bits >> 2u) & 0x33u) : bits;
    return (octant & 4u) != 0u ? ((bits & 0x0Fu) << 4u) | ((bits >> 4u) & 0x0Fu) : bits;
}

// The children of a node that a query meets at a time in [0, t_max], as a group of SphereWalk; 0 if none.
VX_FN uint children_met(SphereNode node, BoxQuery query, float t_max) {
    uvec4 head = node.texels[0];
    uvec4 b = node.texels[1];
    uvec4 c = node.texels[2];
    uvec4 d = node.texels[3];
    float step = uintBitsToFloat((head.w & 255u) << 23u);
    float x = uintBitsToFloat(head.x);
    float y = uintBitsToFloat(head.y);
    float z = uintBitsToFloat(head.z);
    vec3 s = query.scale;
    vec3 n = query.near_origin;
    vec3 f = query.far_origin;
    uint met =
        four_met(four_slabs(b.x, c.z, step, x, s.x, n.x, f.x), four_slabs(b.z, d.x, step, y, s.y, n.y, f.y),
                 four_slabs(c.x, d.z, step, z, s.z, n.z, f.z), t_max);
    met |=
        four_met(four_slabs(b.y, c.w, step, x, s.x, n.x, f.x), four_slabs(b.w, d.y, step, y, s.y, n.y, f.y),
                 four_slabs(c.y, d.w, step, z, s.z, n.z, f.z), t_max)
        << 4u;
    met = in_order(met & ((2u << ((head.w >> 8u) & 7u)) - 1u), query.octant);
    return met != 0u ? ((head.w >> 11u) << 8u) | met : 0u;
}

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
