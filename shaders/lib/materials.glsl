// Materials, as texels: lavapipe loads them for eight invocations at once (lab/notes/film.md).
#ifndef VX_MATERIALS_GLSL
#define VX_MATERIALS_GLSL

#include "shared/gpu_types.h"

layout(rgba32ui) readonly uniform uimageBuffer Materials;

vec4 material_texel(uint material, uint texel) {
    return uintBitsToFloat(imageLoad(Materials, int(kMaterialTexels * material + texel)));
}

vec3 material_albedo(uint material) {
    return material_texel(material, 0u).xyz;
}

vec3 material_emission(uint material) {
    return material_texel(material, 1u).xyz;
}

float material_glass(uint material) {
    return material_texel(material, 1u).w;
}

float material_ior(uint material) {
    return material_texel(material, 2u).x;
}

SurfaceMaterial load_material(uint material) {
    vec4 texels[kMaterialTexels] = vec4[kMaterialTexels](material_texel(material, 0u), material_texel(material, 1u),
                                                         material_texel(material, 2u));
    SurfaceMaterial loaded;
    loaded.albedo = texels[0].xyz;
    loaded.mirror = texels[0].w;
    loaded.emission = texels[1].xyz;
    loaded.glass = texels[1].w;
    loaded.ior = texels[2].x;
    loaded.alpha = texels[2].y;
    loaded.metal_row = floatBitsToUint(texels[2].z);
    loaded.glass_row = floatBitsToUint(texels[2].w);
    return loaded;
}

#endif
