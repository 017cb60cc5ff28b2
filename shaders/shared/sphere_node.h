// A node of the hierarchy over spheres (sphere_tree.h). It has up to eight children, whose boxes are bytes on
// a grid of its own (Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through
// Compressed Wide BVHs").
//
// The texels of a node: the corner of its grid, and in the last word the number of the first child << 11,
// children - 1 << 8 and the biased exponent of the grid's step; then a byte for each end of the children's
// boxes, two words an axis, low x, y and z before high x, y and z.
// The texels of a sphere: the anchor, and the number of the sphere << 8 and kSphereLeaf; the normal, and the
// curvature; nothing in the others.
#ifndef VX_SPHERE_NODE_H
#define VX_SPHERE_NODE_H

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

// The children of a node that a query meets at a time in [0, t_max]: 0 if none, else the number of the first
// child << 8 and a bit for each in the order of the ray.
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

VX_END

#endif
