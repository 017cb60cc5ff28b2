// Emitters: how they are packed, and the probability densities of sampling them. An emitter is selected in
// proportion to its power: the light selection weight of its radiance times its etendue (power / radiance).
#ifndef VX_LIGHT_H
#define VX_LIGHT_H

#include "gpu_types.h"
#include "limits.h"
#include "portable.h"
#include "sppm.h"

VX_BEGIN

// Kinds of emitters, the lowest bit of LightRecord::what.
VX_CONST(uint, kLightSphere, 0u);
VX_CONST(uint, kLightFace, 1u);

// An emitting sphere by its index.
VX_FN uint light_sphere(uint sphere) {
    return (sphere << 1u) | kLightSphere;
}

// A face 0..5 of an emitting voxel of `material` < 2^28.
VX_FN uint light_face(uint face, uint material) {
    return (material << 4u) | (face << 1u) | kLightFace;
}

struct LightParts {
    uint kind;
    uint sphere;    // of a sphere
    uint face;      // of a face
    uint material;  // of a face
};

VX_FN LightParts light_parts(uint what) {
    LightParts parts;
    parts.kind = what & 1u;
    parts.sphere = what >> 1u;
    parts.face = (what >> 1u) & 7u;
    parts.material = what >> 4u;
    return parts;
}

// Light selection weight of a radiance.
VX_FN float brightness(vec3 v) {
    return v.x + v.y + v.z;
}

// Etendue (power / radiance) of a voxel face: pi times its area, 1.
VX_CONST(float, kFaceEtendue, kPi);

// Weight of a direction drawn by one of two sampling techniques, by the balance heuristic; the densities of
// both are given, that of the drawing one first. 0 where neither can draw it. Source: Veach and Guibas 1995,
// "Optimally Combining Sampling Techniques for Monte Carlo Rendering".
VX_FN float balance_weight(float own_pdf, float other_pdf) {
    float sum = own_pdf + other_pdf;
    if (!(sum > 0.0f)) return 0.0f;
    return isinf(sum) ? (isinf(own_pdf) ? 1.0f : 0.0f) : own_pdf / sum;
}

VX_END

#endif
