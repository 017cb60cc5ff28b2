#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Light that reaches each hit straight from a lamp: the mean of the lamps' radiance over the cosine-weighted hemisphere,
// irradiance / pi. One ray goes to a lamp drawn by power, one where a diffuse surface would send it; the balance
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

struct Aim {
    vec3 direction;  // unit; of no meaning when pdf is 0
    float pdf;       // per solid angle, with which it was drawn
    DrawnLight lamp;
};

Aim aim_at_lamp(vec3 origin, uint bits, float u, vec2 u_point) {
    Aim aim;
    aim.lamp = draw_light(bits, u);
    aim.pdf = 0.0;
    aim.direction = vec3(0.0, 0.0, 1.0);
    if (aim.lamp.parts.kind == kLightSphere) {
        Sphere shape = spheres[aim.lamp.parts.sphere].shape;
        SphereCone cone = sphere_cone(sphere_centre(shape) - origin, 1.0 / shape.curvature);
        if (cone.height > 0.0) {
            aim.direction = uniform_cone(cone.axis, cone.height, u_point);
            aim.pdf = aim.lamp.pdf * sphere_cone_pdf(cone);
        }
    } else {
        uint axis = aim.lamp.parts.face >> 1u;
        float on_face = float(aim.lamp.parts.face & 1u);
        vec3 point = vec3(axis == 0u ? on_face : u_point.x, axis == 1u ? on_face : (axis == 0u ? u_point.x : u_point.y),
                          axis == 2u ? on_face : u_point.y);
        vec3 way = local_position(aim.lamp.cell, point) - origin;
        float square = dot(way, way);
        aim.direction = way / sqrt(square);
        float cosine = -dot(aim.direction, face_normal(aim.lamp.parts.face));
        if (cosine > 0.0 && square > 0.0) aim.pdf = aim.lamp.pdf * square / cosine;
    }
    return aim;
}

bool is_on_lamp(Hit hit, DrawnLight lamp) {
    if (lamp.parts.kind == kLightSphere) return is_on_sphere(hit) && hit.sphere == lamp.parts.sphere;
    return !is_on_sphere(hit) && hit.face == lamp.parts.face && hit.cell == lamp.cell;
}

void main() {
    open_scene();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index];
    vec3 light = vec3(0.0);
    uint rays = 0u;
    if (is_surface(hit) && hit.face != kFaceInside) {
        SampleKey key = pixel_key(pixel);
        vec3 normal = surface_normal(hit);
        vec3 origin = local_position(hit.cell, hit.fraction);
        vec2 u_lamp = draw_2d(key, kPairLampPoint);
        vec2 u_surface = draw_2d(key, kPairSurface);
        uint bits = unit_bits(draw_1d(key, 2u * kPairLamp));
        Aim aim = aim_at_lamp(origin, bits, sample_1d(kSequenceWhite, key, 2u * kPairLamp + 1u), u_lamp);
        for (uint i = 0u; i < 2u; ++i) {
            vec3 direction = i == 0u ? aim.direction : cosine_about(normal, u_surface);
            float cosine = dot(normal, direction);
            bool traced = cosine > 0.0 && (i == 1u || aim.pdf > 0.0);
            if (!traced) continue;
            ++rays;
            Hit met = next_hit(path_from(hit, direction)).hit;
            if (!is_surface(met) || (i == 0u && !is_on_lamp(met, aim.lamp))) continue;
            vec3 emission = materials[met.material].emission;
            float lamp_pdf = light_pdf(origin, direction, met, emission);
            if (lamp_pdf == 0.0) continue;
            float surface_pdf = cosine * kInversePi;
            float weight = i == 0u ? balance_weight(lamp_pdf, surface_pdf) : balance_weight(surface_pdf, lamp_pdf);
            light += emission * (weight * (i == 0u ? surface_pdf / aim.pdf : 1.0));
        }
    }
    count(kWorkPathSegments, rays);
    direct[pixel.index] = light;
}
