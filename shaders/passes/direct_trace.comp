#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Light that reaches each hit straight from an emitter: the mean of the emitters' radiance over the cosine-weighted hemisphere,
// irradiance / pi. One ray goes to an emitter drawn by power, one where a diffuse surface would send it; the balance
// heuristic weighs them. Source: Veach and Guibas 1995.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/path.glsl"

#include "lib/lights.glsl"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) writeonly buffer Direct {
    vec3 direct[];
};

struct LightSample {
    vec3 direction;  // unit; of no meaning when pdf is 0
    float pdf;       // per solid angle, with which it was drawn
    DrawnLight emitter;
};

LightSample aim_at_emitter(vec3 origin, uint bits, float u, vec2 u_point) {
    LightSample aim;
    aim.emitter = sample_light(bits, u);
    aim.pdf = 0.0;
    aim.direction = vec3(0.0, 0.0, 1.0);
    if (aim.emitter.parts.kind == kLightSphere) {
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
    if (emitter.parts.kind == kLightSphere) return is_on_sphere(hit) && hit.sphere == emitter.parts.sphere;
    return !is_on_sphere(hit) && hit.face == emitter.parts.face && hit.cell == emitter.cell;
}

void main() {
    init_scene();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    vec3 light = vec3(0.0);
    uint rays = 0u;
    if (is_surface(hit) && hit.face != kFaceInside) {
        SampleKey key = pixel_key(pixel);
        vec3 normal = surface_normal(hit);
        vec3 origin = local_position(hit.cell, hit.fraction);
        vec2 u_emitter = draw_2d(key, kPairEmitterPoint);
        vec2 u_surface = draw_2d(key, kPairSurface);
        uint bits = unit_bits(draw_1d(key, 2u * kPairEmitter));
        LightSample aim = aim_at_emitter(origin, bits, sample_1d(kSequenceWhite, key, 2u * kPairEmitter + 1u), u_emitter);
        for (uint i = 0u; i < 2u; ++i) {
            vec3 direction = i == 0u ? aim.direction : cosine_about(normal, u_surface);
            float cosine = dot(normal, direction);
            bool traced = cosine > 0.0 && (i == 1u || aim.pdf > 0.0);
            if (!traced) continue;
            ++rays;
            Hit met = next_hit(path_from(hit, direction)).hit;
            if (!is_surface(met) || (i == 0u && !is_on_emitter(met, aim.emitter))) continue;
            vec3 emission = materials[met.material].emission;
            float emitter_pdf = light_pdf(origin, direction, met, emission);
            if (emitter_pdf == 0.0) continue;
            float surface_pdf = cosine * kInversePi;
            float weight = i == 0u ? balance_weight(emitter_pdf, surface_pdf) : balance_weight(surface_pdf, emitter_pdf);
            light += emission * (weight * (i == 0u ? surface_pdf / aim.pdf : 1.0));
        }
    }
    count(kWorkPathSegments, rays);
    direct[pixel.index] = light;
}
