#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Draws where the photons of a sample start. Emitters are Lambertian; the sun's photons start on a disc that
// faces it. All photons of a sample are one point set of the sample sequence, scrambled by the index of the
// sample; the photons of a run start together.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/path.glsl"

#include "lib/lights.glsl"
#include "lib/photon_aim.glsl"
#include "lib/photon_frame.glsl"
#include "lib/photon_start.glsl"

VX_SPECIALIZED(uint, aims, 0u);  // towards mirrors and glass

PhotonStart start_at(vec3 position) {
    PhotonStart start;
    vec3 corner = floor(position);
    start.cell = ivec3(corner);
    start.fraction = clamp(position - corner, vec3(0.0), vec3(1.0));
    start.sphere = kNoSphere;
    return start;
}

PhotonStart leave_sphere(DrawnLight emitter, vec2 u_point, vec2 u_direction) {
    Sphere shape = spheres[emitter.parts.sphere].shape;
    SphereEmission emission = sphere_emission(u_point, u_direction);
    float share = 1.0;
    if (aims != 0u) {
        AimMap map = map_of_light(emitter.number);
        emission.direction = aimed_anywhere(aimed_point(map, u_direction));
        emission.normal = cosine_about(emission.direction, u_point);  // as seen from there: a disc
        share = aim_area(map);
    }
    PhotonStart start = start_at(shape.anchor + (emission.normal - shape.normal) / shape.curvature);
    start.direction = emission.direction;
    start.sphere = emitter.parts.sphere;
    start.power = emitter.emission * (sphere_emission_etendue(1.0 / shape.curvature) * share);
    return start;
}

PhotonStart leave_face(DrawnLight emitter, vec2 u_point, vec2 u_direction) {
    uint axis = emitter.parts.face >> 1u;
    vec3 fraction = vec3(u_point.x, axis == 0u ? u_point.x : u_point.y, u_point.y);
    vec3 direction = cosine_on_face(emitter.parts.face, u_direction);
    float share = 1.0;
    if (aims != 0u) {
        AimMap map = map_of_light(emitter.number);
        direction = off_face(emitter.parts.face, aimed_cosine(aimed_point(map, u_direction)));
        share = aim_area(map);
    }
    Ray ray = spawn_ray(emitter.cell, emitter.parts.face, fraction, direction, kUnbounded);
    PhotonStart start;
    start.cell = ray.cell;
    start.fraction = ray.fraction;
    start.direction = ray.direction;
    start.sphere = kNoSphere;
    start.power = emitter.emission * (kFaceEtendue * share);
    return start;
}

PhotonStart leave_sun_aimed(vec2 u_point, vec2 u_direction) {
    AimMap map = aim_maps[0];
    AimedSun sun = aimed_sun(frame.sun_direction, frame.sun_cone_height, u_direction, aimed_point(map, u_point),
                             frame.sun_disc_radius);
    PhotonStart start = start_at(frame.sun_disc_centre + sun.place);
    start.direction = -sun.towards;
    start.power = frame.sun_irradiance * aim_area(map);
    return start;
}

PhotonStart leave_sun(vec2 u_point, vec2 u_direction) {
    if (aims != 0u) return leave_sun_aimed(u_point, u_direction);
    vec3 towards = uniform_cone(frame.sun_direction, frame.sun_cone_height, u_direction);
    vec3 disk = concentric_disk(u_point);
    vec3 local = frame.sun_disc_radius * vec3(disk.x, disk.y, 1.0);
    PhotonStart start = start_at(frame.sun_disc_centre + from_basis(basis_around(towards), local));
    start.direction = -towards;
    start.power = frame.sun_irradiance * (frame.sun_disc_radius * frame.sun_disc_radius / kInversePi);
    return start;
}

void main() {
    init_photons();
    uint place = linear_id();
    if (place >= photon.photons) return;
    uint id = photon.first_photon + place;
    SampleKey key = sample_key(frame.sample_index, uvec2(id, 0u), frame.seed);
    vec2 u_choice = draw_2d(key, kPairPhoton);
    vec2 u_point = draw_2d(key, kPairPhoton + 1u);
    vec2 u_direction = draw_2d(key, kPairPhoton + 2u);
    PhotonStart start;
    if (id >= frame.emitter_photons) {
        start = leave_sun(u_point, u_direction);
        start.power /= float(frame.sun_photons);
    } else {
        DrawnLight emitter = sample_light(unit_bits(u_choice.x), u_choice.y);
        if (is_sphere(emitter)) {
            start = leave_sphere(emitter, u_point, u_direction);
        } else {
            start = leave_face(emitter, u_point, u_direction);
        }
        start.power /= emitter.pdf * float(frame.emitter_photons);
    }
    start.noise = rng_uint(frame.seed, frame.sample_index, id, 2u * kPairBounce);
    put_start(place, start);
}
