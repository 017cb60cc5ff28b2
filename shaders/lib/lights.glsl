// Emitters. Include lib/path.glsl first.
#ifndef VX_LIGHTS_GLSL
#define VX_LIGHTS_GLSL

#include "shared/alias.h"
#include "shared/light.h"

layout(scalar) readonly buffer Lights {
    LightRecord lights[];
};
layout(scalar) readonly buffer LightTable {
    AliasEntry light_table[];
};

// An emitter, and the probability with which it was drawn.
struct DrawnLight {
    LightParts parts;
    ivec3 cell;
    vec3 emission;
    float pdf;
};

DrawnLight sample_light(uint bits, float u) {
    uint bucket = min(alias_bucket(bits, frame.light_count), frame.light_count - 1u);
    uint i = alias_choice(light_table[bucket], bucket, u);
    DrawnLight drawn;
    drawn.parts = light_parts(lights[i].what);
    drawn.cell = lights[i].cell;
    drawn.pdf = light_table[i].pdf;
    uint material = drawn.parts.kind == kLightSphere ? spheres[drawn.parts.sphere].material : drawn.parts.material;
    drawn.emission = materials[material].emission;
    return drawn;
}

vec3 sphere_centre(Sphere shape) {
    return shape.anchor - shape.normal / shape.curvature;
}

// Per solid angle: the density with which an emitter drawn by its power, and a point of it, give the direction from
// `origin` to a hit on it. 0 where the hit does not shine at `origin`. In weights only: draws use the table's numbers.
float light_pdf(vec3 origin, vec3 direction, Hit hit, vec3 emission) {
    float shining = brightness(emission) / frame.light_power;
    if (is_on_sphere(hit)) {
        float radius = 1.0 / spheres[hit.sphere].shape.curvature;
        SphereCone cone = sphere_cone(sphere_centre(spheres[hit.sphere].shape) - origin, radius);
        bool is_seen = hit.face == kFaceSphere && cone.height > 0.0;
        return is_seen ? shining * sphere_emission_etendue(radius) * sphere_cone_pdf(cone) : 0.0;
    }
    float cosine = -dot(direction, face_normal(hit.face));
    vec3 way = local_position(hit.cell, hit.fraction) - origin;
    return cosine > 0.0 && hit.face < kFaceInside ? shining * kFaceEtendue * dot(way, way) / cosine : 0.0;
}

#endif
