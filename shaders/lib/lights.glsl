// Emitters. Include lib/path.glsl first.
#ifndef VX_LIGHTS_GLSL
#define VX_LIGHTS_GLSL

#include "shared/alias.h"
#include "shared/light.h"

// Texels, because lavapipe loads them for eight invocations at once (lab/notes/film.md).
layout(rgba32ui) readonly uniform uimageBuffer Lights;    // one LightRecord each
layout(r32ui) readonly uniform uimageBuffer LightTable;  // kAliasWords per AliasEntry

// An emitter, and the probability with which it was selected.
struct DrawnLight {
    uint number;  // in the list
    LightParts parts;
    ivec3 cell;
    vec3 emission;
    float pdf;
};

bool is_sphere(DrawnLight emitter) {
    return sphere_count != 0u && emitter.parts.kind == kLightSphere;
}

AliasEntry load_alias(uint i) {
    int first = int(kAliasWords * i);
    AliasEntry entry;
    entry.keep = uintBitsToFloat(imageLoad(LightTable, first).x);
    entry.other = imageLoad(LightTable, first + 1).x;
    entry.pdf = uintBitsToFloat(imageLoad(LightTable, first + 2).x);
    return entry;
}

DrawnLight sample_light(uint bits, float u) {
    uint bucket = min(alias_bucket(bits, frame.light_count), frame.light_count - 1u);
    uint i = alias_choice(load_alias(bucket), bucket, u);
    DrawnLight drawn;
    uvec4 light = imageLoad(Lights, int(i));
    drawn.number = i;
    drawn.cell = ivec3(light.xyz);
    drawn.parts = light_parts(light.w);
    drawn.pdf = load_alias(i).pdf;
    uint material = is_sphere(drawn) ? spheres[drawn.parts.sphere].material : drawn.parts.material;
    drawn.emission = material_emission(material);
    return drawn;
}

vec3 sphere_centre(Sphere shape) {
    return shape.anchor - shape.normal / shape.curvature;
}

struct LightSample {
    vec3 direction;  // unit; undefined when pdf is 0
    float pdf;       // per solid angle
    DrawnLight emitter;
};

// Samples a point of an emitter selected in proportion to its power.
LightSample aim_at_emitter(vec3 origin, uint bits, float u, vec2 u_point) {
    LightSample aim;
    aim.emitter = sample_light(bits, u);
    aim.pdf = 0.0;
    aim.direction = vec3(0.0, 0.0, 1.0);
    if (is_sphere(aim.emitter)) {
        Sphere shape = spheres[aim.emitter.parts.sphere].shape;
        SphereCone cone = sphere_cone(sphere_centre(shape) - origin, 1.0 / shape.curvature);
        if (cone.height > 0.0) {
            aim.direction = uniform_cone(cone.axis, cone.height, u_point);
            aim.pdf = aim.emitter.pdf * sphere_cone_pdf(cone);
        }
    } else {
        uint axis = aim.emitter.parts.face >> 1u;
        float on_face = float(aim.emitter.parts.face & 1u);
        vec3 point = vec3(axis == 0u ? on_face : u_point.x, axis == 1u ? on_face : (axis == 0u ? u_point.x : u_point.y),
                          axis == 2u ? on_face : u_point.y);
        vec3 way = local_position(aim.emitter.cell, point) - origin;
        float square = dot(way, way);
        aim.direction = way / sqrt(square);
        float cosine = -dot(aim.direction, face_normal(aim.emitter.parts.face));
        if (cosine > 0.0 && square > 0.0) aim.pdf = aim.emitter.pdf * square / cosine;
    }
    return aim;
}

bool is_on_emitter(Hit hit, DrawnLight emitter) {
    if (is_sphere(emitter)) return is_on_sphere(hit) && hit.sphere == emitter.parts.sphere;
    return !is_on_sphere(hit) && hit.face == emitter.parts.face && hit.cell == emitter.cell;
}

// The pdf per solid angle with which sampling an emitter by power, and a point on it, gives the direction
// from `origin` to a hit on it. 0 where the hit does not shine towards `origin`. For MIS weights only:
// sampling uses the table's numbers.
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
