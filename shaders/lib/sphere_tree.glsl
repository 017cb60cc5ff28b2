// The hierarchy over the spheres, walked where there are more than a few.
#ifndef VX_SPHERE_TREE_GLSL
#define VX_SPHERE_TREE_GLSL

#include "lib/spheres.glsl"

layout(scalar) readonly buffer SphereTree {
    SphereNode sphere_tree[];
};

#define VX_SPHERES_PARAM
#define VX_SPHERES_ARG

SphereNode load_sphere_node(uint i) {
    return sphere_tree[i];
}

Sphere load_sphere(uint i) {
    return spheres[i].shape;
}

#include "shared/sphere_tree.h"

const bool has_sphere_tree = sphere_count > kFewSpheres;
const uint sphere_nodes = 2u * sphere_count - 1u;

#endif
