// A path from a visible point on, ray by ray. Each diffuse surface sends up to three rays, one after the other: to the
// sun, to an emitter, and on. The balance heuristic weighs the last two (Veach and Guibas 1995).
// Include lib/path.glsl, lib/lights.glsl and lib/photon_start.glsl first.
//
// Each way of light is found once. Straight to the visible point: from the sky by the path; from sun and emitters by
// sun.trace and direct.trace, so the path leaves them out. By mirrors and glass alone to the visible point: by the
// path where caustics are its own (finds_caustics), else by photons. All other light: by the path.
#ifndef VX_PATH_WALK_GLSL
#define VX_PATH_WALK_GLSL

#include "shared/dimensions.h"

VX_SPECIALIZED(uint, has_sun, 0u);
VX_SPECIALIZED(uint, has_emitters, 0u);
VX_SPECIALIZED(uint, has_specular, 0u);
VX_SPECIALIZED(uint, finds_caustics, 0u);
VX_SPECIALIZED(uint, aims_at_emitters, 1u);  // 0: only chance finds them
VX_SPECIALIZED(uint, sure_surfaces, 2u);   // after the visible point, that roulette leaves alone

// Turns of loops over spheres for a ray, where they are not unrolled.
const uint sphere_turns = sphere_count <= kFewSpheres ? 0u : sphere_count + glass_spheres;

const uint kRayNone = 0u;  // no path is under way
const uint kRayOn = 1u;
const uint kRaySun = 2u;
const uint kRayEmitter = 3u;

struct Walk {
    PathRay ray;
    uint kind;        // kRay*
    uint stream;      // of samples of its pixel
    vec3 normal;      // of the diffuse surface that the ray leaves
    vec3 throughput;  // product of the albedos on the way
    float scale;      // of radiance, by refraction
    float pdf;        // per solid angle: the density with which that surface sends light where the ray goes
    vec3 light;       // that was found
    uint surfaces;    // met
    uint vertices;    // diffuse ones, the visible point included
    bool is_straight;    // nothing was met since the last of them
    vec3 expected;       // what a ray to the sun or, but for its radiance, to an emitter brings where nothing is in its way
    DrawnLight emitter;  // that it goes to
};

// Of the frame, held because lavapipe would load it anew in every turn of a loop (shaders/README.md).
vec3 sky;
vec3 sun_irradiance;
vec3 sun_direction;
float sun_height;
SampleKey sample_of_frame;

void init_walks() {
    sky = frame.sky_radiance;
    sun_irradiance = frame.sun_irradiance;
    sun_direction = frame.sun_direction;
    sun_height = frame.sun_cone_height;
    sample_of_frame = sample_key(0u, uvec2(frame.sample_index, 0u), frame.seed);
}

Walk no_walk() {
    Walk walk;
    walk.kind = kRayNone;
    walk.ray.cell = ivec3(-1);
    walk.ray.fraction = vec3(0.5);
    walk.ray.direction = vec3(0.0, 0.0, 1.0);
    walk.ray.own = kNoSphere;
    walk.ray.medium = kNoMedium;
    walk.stream = 0u;
    walk.normal = vec3(0.0, 0.0, 1.0);
    walk.throughput = vec3(0.0);
    walk.scale = 1.0;
    walk.pdf = 0.0;
    walk.light = vec3(0.0);
    walk.surfaces = 0u;
    walk.vertices = 1u;
    walk.is_straight = true;
    walk.expected = vec3(0.0);
    walk.emitter.cell = ivec3(-1);
    walk.emitter.emission = vec3(0.0);
    walk.emitter.pdf = 0.0;
    walk.emitter.parts = light_parts(0u);
    return walk;
}

// A start without a direction becomes a path that carries nothing.
Walk first_walk(PhotonStart start) {
    bool is_path = start.direction != vec3(0.0);
    Walk walk = no_walk();
    walk.kind = kRayOn;
    walk.ray.cell = start.cell;
    walk.ray.fraction = start.fraction;
    walk.ray.direction = is_path ? start.direction : walk.ray.direction;
    walk.ray.own = start.sphere;
    walk.stream = start.noise;
    walk.throughput = vec3(is_path ? 1.0 : 0.0);
    walk.light = start.power;
    return walk;
}

Walk walk_of(PathState state) {
    Walk walk = no_walk();
    walk.ray.cell = state.cell;
    walk.ray.fraction = state.fraction;
    walk.ray.direction = state.direction;
    walk.ray.own = state.own;
    walk.ray.medium = state.medium;
    walk.kind = state.kind;
    walk.stream = state.stream;
    walk.throughput = state.throughput;
    walk.scale = state.scale;
    walk.pdf = state.pdf;
    walk.light = state.light;
    walk.surfaces = state.surfaces;
    walk.vertices = state.vertices;
    walk.is_straight = state.is_straight != 0u;
    return walk;
}

PathState state_of(Walk walk, uint next_id) {
    PathState state;
    state.cell = walk.ray.cell;
    state.fraction = walk.ray.fraction;
    state.direction = walk.ray.direction;
    state.own = walk.ray.own;
    state.medium = walk.ray.medium;
    state.kind = walk.kind;
    state.stream = walk.stream;
    state.throughput = walk.throughput;
    state.scale = walk.scale;
    state.pdf = walk.pdf;
    state.light = walk.light;
    state.surfaces = walk.surfaces;
    state.vertices = walk.vertices;
    state.is_straight = walk.is_straight ? 1u : 0u;
    state.next_id = next_id;
    return state;
}

vec3 numbers_of(Walk walk, uint use) {
    SampleKey key = sample_of_frame;
    key.stream = walk.stream;
    return path_numbers(key, walk.surfaces, use);
}

// Of the light of sun and emitters that the path's own ray meets: 0 where others find it, 1 where nothing else does.
float share_of_path(Walk walk, float emitter_pdf) {
    bool is_first = walk.vertices == 1u;
    if (!walk.is_straight) return is_first && finds_caustics == 0u ? 0.0 : 1.0;
    if (is_first) return 0.0;
    return aims_at_emitters != 0u ? balance_weight(walk.pdf, emitter_pdf) : 1.0;
}

void take_emission(inout Walk walk, PathHit found) {
    vec3 emission = materials[found.hit.material].emission;
    vec3 origin = local_position(walk.ray.cell, walk.ray.fraction);
    float emitter_pdf = light_pdf(origin, walk.ray.direction, found.hit, emission);
    if (!(emitter_pdf > 0.0)) return;
    vec3 carried = walk.throughput * (walk.scale * share_of_path(walk, emitter_pdf));
    bool is_aimed = walk.kind == kRayEmitter && is_on_emitter(found.hit, walk.emitter);
    vec3 aimed = is_aimed ? walk.expected * balance_weight(emitter_pdf, walk.pdf) : vec3(0.0);
    walk.light += emission * (walk.kind == kRayOn ? carried : aimed);
}

// Adds the light of what a ray has met.
void take_light(inout Walk walk, PathHit found) {
    if (has_emitters != 0u && is_surface(found.hit)) take_emission(walk, found);
    if (is_surface(found.hit) || walk.kind == kRayEmitter) return;
    vec3 radiance = sky;
    if (has_sun != 0u && has_specular != 0u && !walk.is_straight) {
        bool in_sun = is_in_cone(walk.ray.direction, sun_direction, sun_height);
        if (in_sun) radiance += sun_irradiance * (share_of_path(walk, 0.0) / cone_solid_angle(sun_height));
    }
    walk.light += walk.kind == kRaySun ? walk.expected : walk.throughput * walk.scale * radiance;
}

// What the path's own ray does at a surface. False where the path ends.
bool scatter(inout Walk walk, PathHit found) {
    vec3 u = numbers_of(walk, kUseEvent);
    BsdfSample event;
    event.kind = kEventDiffuse;
    event.albedo = materials[found.hit.material].albedo;
    if (has_specular != 0u) event = path_event(walk.ray, found, u.xy);
    bool is_diffuse = event.kind == kEventDiffuse;
    if (event.kind != kEventPass) walk.throughput *= event.albedo;
    if (event.kind == kEventRefract) walk.scale *= radiance_scale(event.eta);
    PathRay start = path_from(found.hit, walk.ray.direction);
    start.medium = walk.ray.medium;
    if (has_specular != 0u && !is_diffuse) start = path_after(walk.ray, found, event);
    walk.ray = start;
    walk.is_straight = is_diffuse;
    walk.normal = found.normal;
    walk.vertices += is_diffuse ? 1u : 0u;
    ++walk.surfaces;
    float survival = walk.surfaces > sure_surfaces ? roulette_survival(walk.throughput) : 1.0;
    bool goes_on = u.z < survival && max(walk.throughput.x, max(walk.throughput.y, walk.throughput.z)) > 0.0;
    walk.throughput /= goes_on ? survival : 1.0;
    return goes_on;
}

// Aims at an emitter. False where it cannot send light here.
bool leave_to_emitter(inout Walk walk) {
    vec3 u = numbers_of(walk, kUseEmitter);
    vec3 u_point = numbers_of(walk, kUseEmitterPoint);
    vec3 origin = local_position(walk.ray.cell, walk.ray.fraction);
    LightSample aim = aim_at_emitter(origin, unit_bits(u.x), u.y, u_point.xy);
    walk.pdf = max(dot(walk.normal, aim.direction), 0.0) * kInversePi;
    if (!(aim.pdf > 0.0 && walk.pdf > 0.0)) return false;
    walk.emitter = aim.emitter;
    walk.expected = walk.throughput * (walk.scale * walk.pdf / aim.pdf);
    walk.ray.direction = aim.direction;
    return true;
}

bool leave_to_sun(inout Walk walk) {
    vec3 direction = uniform_cone(sun_direction, sun_height, numbers_of(walk, kUseSun).xy);
    float cosine = dot(walk.normal, direction);
    if (!(cosine > 0.0)) return false;
    walk.expected = walk.throughput * sun_irradiance * (walk.scale * cosine * kInversePi);
    walk.ray.direction = direction;
    return true;
}

// The next ray of a diffuse surface. `last` is the kind of the one before, kRayNone for the first.
void leave(inout Walk walk, uint last) {
    walk.kind = kRayOn;
    if (has_sun != 0u && last == kRayNone && leave_to_sun(walk)) walk.kind = kRaySun;
    bool may_aim = has_emitters != 0u && aims_at_emitters != 0u && last != kRayEmitter && walk.kind == kRayOn;
    if (may_aim && leave_to_emitter(walk)) walk.kind = kRayEmitter;
    if (walk.kind != kRayOn) return;
    walk.ray.direction = cosine_about(walk.normal, numbers_of(walk, kUseDirection).xy);
    walk.pdf = dot(walk.normal, walk.ray.direction) * kInversePi;
}

#endif
