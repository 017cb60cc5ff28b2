// The hierarchy over the spheres, walked where there are more than a few.
#ifndef VX_SPHERE_TREE_GLSL
#define VX_SPHERE_TREE_GLSL

#include "lib/spheres.glsl"

layout(rgba32ui) readonly uniform uimageBuffer SphereTree;

#define VX_SPHERES_PARAM
#define VX_SPHERES_ARG

SphereNode load_sphere_node(uint i) {
    SphereNode node;
    for (uint k = 0u; k < 4u; ++k)
        node.texels[k] = imageLoad(SphereTree, int(4u * i + k));
    return node;
}

#include "shared/sphere_tree.h"

const bool has_sphere_tree = sphere_count > kFewSpheres;

#endif
