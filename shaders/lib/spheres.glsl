// The analytic spheres. Their number is a specialization constant: lavapipe would compile a loop bounded by a
// member of a uniform block anew for each dispatch.
#ifndef VX_SPHERES_GLSL
#define VX_SPHERES_GLSL

#include "lib/constants.glsl"
#include "shared/gpu_types.h"
#include "shared/limits.h"
#include "shared/sampling.h"

VX_SPECIALIZED(uint, sphere_count, 0u);
VX_SPECIALIZED(uint, glass_spheres, 0u);  // the first of the list are of glass
VX_SPECIALIZED(uint, has_ground, 0u);     // the last one is a horizontal plane

layout(scalar) readonly buffer Spheres {
    SphereRecord spheres[];
};

// Few spheres are tested in an unrolled loop over constant indices of an array.
layout(scalar) uniform SphereTable {
    SphereRecord sphere_table[kFewSpheres];
};

SphereRecord held_spheres[kFewSpheres];

// Copies the few spheres once. Lavapipe loads a member of a uniform block for each invocation separately,
// even at constant indices, and again in every turn of a loop: three quarters of a sphere test would be
// loads.
void load_spheres() {
    for (uint i = 0u; i < kFewSpheres; ++i)
        held_spheres[i] = sphere_table[i];
}

bool is_surface(Hit hit) {
    return hit.face <= kFaceSphereInside;
}

bool is_on_sphere(Hit hit) {
    return sphere_count != 0u && (hit.face == kFaceSphere || hit.face == kFaceSphereInside);
}

// The sphere on which a ray from a hit starts.
uint own_sphere(Hit hit) {
    return is_on_sphere(hit) ? hit.sphere : kNoSphere;
}

// Unit, on the side that was hit.
vec3 surface_normal(Hit hit) {
    if (is_on_sphere(hit)) {
        Sphere shape = spheres[hit.sphere].shape;
        vec3 from_anchor = (vec3(hit.cell) - shape.anchor) + hit.fraction;
        vec3 outward = normalize(shape.normal + shape.curvature * from_anchor);
        return hit.face == kFaceSphereInside ? -outward : outward;
    }
    return face_normal(hit.face);
}

#endif
