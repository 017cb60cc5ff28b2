// A path that starts at a visible point, ray by ray. Each diffuse or rough surface sends up to four rays, one
// after the other: to the sun, to an image of the sun, to an emitter, and the path's own next ray; under an
// image of the sky a fifth, to a texel of it. The balance heuristic weighs light that several of them can find
// (Veach and Guibas 1995). Include lib/path.glsl and lib/lights.glsl first.
//
// Each light path is found exactly once. Direct light at the visible point: from the sky by the path; from
// the sun by sun.trace; from emitters by direct.trace, which aims at them, together with the path's first
// ray, which hits them (shares_direct), or else by direct.trace alone. Light of sun and emitters that reaches
// any diffuse surface by way of mirrors and glass: by the path where it finds it (finds_sun_caustics,
// finds_emitter_caustics), else by photons. All light at a rough visible point, and all other light: by the
// path.
#ifndef VX_PATH_WALK_GLSL
#define VX_PATH_WALK_GLSL

#include "lib/path_rough.glsl"
#include "lib/path_sun.glsl"
#include "lib/sky.glsl"
#include "lib/sky_image.glsl"
#include "shared/dimensions.h"

VX_SPECIALIZED(uint, has_atmosphere, 0u);  // else the sky is constant
VX_SPECIALIZED(uint, has_sun, 0u);
VX_SPECIALIZED(uint, has_emitters, 0u);
VX_SPECIALIZED(uint, has_specular, 0u);
VX_SPECIALIZED(uint, finds_sun_caustics, 0u);
VX_SPECIALIZED(uint, finds_emitter_caustics, 0u);
VX_SPECIALIZED(uint, aims_at_emitters, 1u);  // 0: only random rays find them
VX_SPECIALIZED(uint, aims_at_sky, 0u);  // at an image of it
VX_SPECIALIZED(uint, shares_direct, 0u);  // the path's first ray finds emitters, too
VX_SPECIALIZED(uint, min_surfaces, 4u);   // beyond the visible point, before roulette starts

const uint kRayNone = 0u;  // no path is under way
const uint kRayOn = 1u;
const uint kRaySun = 2u;
const uint kRayImage = 3u;  // to an image of the sun
const uint kRayEmitter = 4u;
const uint kRaySky = 5u;  // to a texel of an image of the sky

struct Walk {
    PathRay ray;
    PathRay vertex;   // where rays of the current diffuse surface start
    vec3 ahead;       // at the visible point: the direction of the path's own ray
    uint kind;        // kRay*
    uint stream;      // sample stream of its pixel
    vec3 normal;      // of the diffuse or rough surface that the ray leaves
    RoughVertex rough;  // what that surface is beyond this
    vec3 gain;        // by a rough surface: value times cosine / pdf of the ray
    float bend;       // factor of radiance by refraction there
    vec3 throughput;  // product of the albedos so far
    float scale;      // of radiance, by refraction
    float pdf;        // per solid angle: the density with which that surface samples this direction
    float image_share;  // 1 / (samples that the sun and its images give that direction + solid angle of the sun * pdf)
    vec3 light;       // found so far
    uint surfaces;    // hit so far
    uint glints;      // surfaces hit by a ray to the sun
    uint vertices;    // diffuse and rough surfaces, the visible point included
    bool is_straight;    // no mirror or glass since the last of these
    bool starts_rough;   // at a rough visible point, with the ray that hits it
    vec3 first;          // then, its random numbers (PathStart)
    vec3 expected;       // what a ray to sun or sky brings; for one to an emitter, the factor of its radiance
    DrawnLight emitter;  // the one aimed at
};

// Copies of the frame's values, because lavapipe would load these anew in every turn of a loop
// (shaders/README.md).
vec3 constant_sky;
vec3 sun_irradiance;
SampleKey sample_of_frame;

void init_walks() {
    constant_sky = frame.sky_radiance;
    sun_irradiance = frame.sun_irradiance;
    init_sun_images();
    init_sky_image();
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
    walk.vertex = walk.ray;
    walk.ahead = walk.ray.direction;
    walk.stream = 0u;
    walk.normal = vec3(0.0, 0.0, 1.0);
    walk.rough = no_rough_vertex(walk.ray);
    walk.gain = vec3(1.0);
    walk.bend = 1.0;
    walk.starts_rough = false;
    walk.first = vec3(0.0);
    walk.throughput = vec3(0.0);
    walk.scale = 1.0;
    walk.pdf = 0.0;
    walk.image_share = 0.0;
    walk.light = vec3(0.0);
    walk.surfaces = 0u;
    walk.glints = 0u;
    walk.vertices = 1u;
    walk.is_straight = true;
    walk.expected = vec3(0.0);
    walk.emitter.cell = ivec3(-1);
    walk.emitter.emission = vec3(0.0);
    walk.emitter.pdf = 0.0;
    walk.emitter.parts = light_parts(0u);
    return walk;
}

// A start without a direction becomes a path without throughput.
Walk first_walk(PathStart start, vec3 light) {
    bool is_path = start.direction != vec3(0.0);
    Walk walk = no_walk();
    walk.kind = kRayOn;
    walk.ray.cell = start.cell;
    walk.ray.fraction = start.fraction;
    walk.ray.direction = is_path ? start.direction : walk.ray.direction;
    walk.ray.own = start.own;
    walk.vertex = walk.ray;
    walk.vertex.medium = start.medium;
    walk.normal = start.normal;
    walk.starts_rough = has_rough != 0u && start.is_rough != 0u;
    walk.first = start.normal;
    if (walk.starts_rough) walk.ray.medium = start.medium;
    walk.pdf = max(dot(start.normal, start.direction), 0.0) * kInversePi;
    walk.ahead = walk.ray.direction;
    walk.stream = start.stream;
    walk.throughput = vec3(is_path ? 1.0 : 0.0);
    walk.light = light;
    return walk;
}

Walk walk_of(PathState state) {
    Walk walk = no_walk();
    walk.ray = state.ray;
    walk.kind = state.kind;
    walk.stream = state.stream;
    walk.throughput = state.throughput;
    walk.scale = state.scale;
    walk.pdf = state.pdf;
    walk.image_share = state.image_share;
    walk.light = state.light;
    walk.surfaces = state.surfaces;
    walk.vertices = state.vertices;
    walk.is_straight = (state.flags & 1u) != 0u;
    walk.rough.alpha = (state.flags & 2u) != 0u ? 1.0 : 0.0;  // whether it is above 0 is all that a ray needs
    return walk;
}

// Whether the surface that the ray has left is rough.
bool is_off_rough(Walk walk) {
    return has_rough != 0u && walk.rough.alpha > 0.0;
}

// Whether it lets light through.
bool is_off_rough_glass(Walk walk) {
    return is_off_rough(walk) && walk.rough.eta != 0.0;
}

// On the way to its rough visible point.
bool is_arriving(Walk walk) {
    return has_rough != 0u && walk.starts_rough && walk.vertices == 1u;
}

PathState state_of(Walk walk, uint next_id) {
    PathState state;
    state.ray = walk.ray;
    state.kind = walk.kind;
    state.stream = walk.stream;
    state.throughput = walk.throughput;
    state.scale = walk.scale;
    state.pdf = walk.pdf;
    state.image_share = walk.image_share;
    state.light = walk.light;
    state.surfaces = walk.surfaces;
    state.vertices = walk.vertices;
    state.flags = (walk.is_straight ? 1u : 0u) | (is_off_rough(walk) ? 2u : 0u);
    state.next_id = next_id;
    return state;
}

vec3 numbers_of(Walk walk, uint use) {
    SampleKey key = sample_of_frame;
    key.stream = walk.stream;
    return path_numbers(key, walk.surfaces + (use == kUseGlint ? walk.glints : 0u), use);
}

const bool has_glints = has_sun != 0u && finds_sun_caustics != 0u;

void set_direction(inout Walk walk, vec3 direction) {
    if (has_specular != 0u) walk.ray = walk.vertex;
    walk.ray.direction = direction;
    walk.pdf = max(dot(walk.normal, direction), 0.0) * kInversePi;
    if (!is_off_rough(walk)) return;
    RoughValue value = evaluate_rough(walk.rough.outward, direction, walk.normal, walk.rough.alpha, walk.rough.eta);
    walk.pdf = value.pdf;
    walk.gain = value.weight * rough_factor(walk.rough, walk.normal, direction);
    bool crosses = value.crosses && value.pdf > 0.0;  // never metal, whose eta is 0
    walk.bend = crosses ? radiance_scale(walk.rough.eta) : 1.0;
    if (!crosses) return;
    walk.ray = walk.rough.beyond;
    walk.ray.direction = direction;
}

// Throughput of a ray that aims at a light. It lacks the factor pdf, which for diffuse surfaces is their value
// times the cosine, too.
vec3 aimed_throughput(Walk walk) {
    return is_off_rough(walk) ? walk.throughput * walk.gain * walk.bend : walk.throughput;
}

// MIS weight of the sun's cone against a direction that a rough surface samples in it.
float share_of_cone(Walk walk) {
    return is_off_rough(walk) ? 1.0 / (1.0 + cone_solid_angle(sun_height) * walk.pdf) : 1.0;
}

// MIS weight of light from sun and emitters that the path's own ray hits: 0 where others find it, 1 where
// nothing else does.
float share_of_path(Walk walk, float emitter_pdf, uint finds_caustics) {
    if (!walk.is_straight) return float(finds_caustics);
    if (walk.vertices == 1u && shares_direct == 0u) return 0.0;
    return aims_at_emitters != 0u ? balance_weight(walk.pdf, emitter_pdf) : 1.0;
}

void take_emission(inout Walk walk, PathHit found) {
    vec3 emission = material_emission(found.hit.material);
    vec3 origin = local_position(walk.ray.cell, walk.ray.fraction);
    float emitter_pdf = light_pdf(origin, walk.ray.direction, found.hit, emission);
    if (!(emitter_pdf > 0.0)) return;
    vec3 carried = walk.throughput * (walk.scale * share_of_path(walk, emitter_pdf, finds_emitter_caustics));
    bool is_aimed = walk.kind == kRayEmitter && is_on_emitter(found.hit, walk.emitter);
    vec3 aimed = is_aimed ? walk.expected * balance_weight(emitter_pdf, walk.pdf) : vec3(0.0);
    walk.light += emission * (walk.kind == kRayOn ? carried : aimed);
}

// The light of the sky that the path's own ray brings, less what rays that aim at it bring.
vec3 sky_seen(Walk walk) {
    if (has_sky_image) {
        vec4 light = sky_image_along(walk.ray.direction);
        bool is_shared = aims_at_sky != 0u && walk.is_straight;
        return light.xyz * (is_shared ? balance_weight(walk.pdf, light.w) : 1.0);
    }
    if (has_atmosphere == 0u) return constant_sky;
    SampleKey key = sample_of_frame;
    key.stream = walk.stream;
    return sky_along(walk.ray.direction, key, 1u + walk.surfaces);
}

// Adds the sun that a rough surface has met by its own sampling.
void take_sun(inout Walk walk) {
    bool meets = is_off_rough(walk) && walk.kind == kRayOn && walk.is_straight;
    if (!meets || !is_in_cone(walk.ray.direction, sun_direction, sun_height)) return;
    walk.light += walk.throughput * sun_irradiance * (walk.scale * walk.pdf * share_of_cone(walk));
}

// Adds the light of what a ray has hit.
void take_light(inout Walk walk, PathHit found) {
    if (is_arriving(walk)) return;
    if (has_emitters != 0u && is_surface(found.hit)) take_emission(walk, found);
    if (is_surface(found.hit) || walk.kind == kRayEmitter) return;
    if (aims_at_sky != 0u && walk.kind == kRaySky) {
        walk.light += walk.expected;
        return;
    }
    if (walk.kind == kRayOn) walk.light += walk.throughput * walk.scale * sky_seen(walk);
    if (walk.kind != kRayOn && walk.is_straight)
        walk.light += walk.kind == kRaySun && walk.vertices > 1u ? walk.expected * share_of_cone(walk) : vec3(0.0);
    if (has_rough != 0u && has_sun != 0u) take_sun(walk);
    if (!has_glints || walk.is_straight) return;
    // Rays to the sun end in its cone, up to rounding.
    if (!is_in_cone(walk.ray.direction, sun_direction, walk.kind == kRayOn ? sun_height : sun_reach)) return;
    vec3 carried = walk.throughput * sun_irradiance * (walk.scale * walk.pdf * share_of_path(walk, 0.0, finds_sun_caustics));
    walk.light += walk.image_share * (walk.kind == kRayOn ? carried : walk.expected);
}

// Samples what a ray does at a surface. `u` are for the choice of the lobe and for Fresnel's choice.
BsdfSample event_at(Walk walk, PathHit found, vec2 u) {
    if (is_arriving(walk)) u.x = walk.first.z;
    if (has_specular != 0u) return path_event(walk.ray, found, u);
    BsdfSample event;
    event.alpha = 0.0;
    event.kind = kEventDiffuse;
    event.albedo = material_albedo(found.hit.material);
    return event;
}

// Continues a ray to the sun beyond a mirror or glass. False where it ends.
bool glint(inout Walk walk, PathHit found, BsdfSample event) {
    if (event.kind == kEventDiffuse || event.kind == kEventRough) return false;
    if (event.kind != kEventPass) walk.expected *= event.albedo;
    if (event.kind == kEventRefract) walk.expected *= radiance_scale(event.eta);
    walk.ray = path_after(walk.ray, found, event);
    walk.is_straight = false;
    ++walk.glints;
    return true;
}

// Continues the path's own ray at a surface; `u` is for roulette. False where the path ends.
bool scatter(inout Walk walk, PathHit found, BsdfSample event, float u) {
    bool is_diffuse = event.kind == kEventDiffuse;
    bool is_vertex = is_diffuse || (has_rough != 0u && event.kind == kEventRough);
    bool is_on_film = is_arriving(walk);  // the film multiplies by the albedo of the visible point
    if (is_on_film && event.kind != kEventRough) return false;
    if (event.kind != kEventPass && !is_on_film) walk.throughput *= event.albedo;
    if (event.kind == kEventRefract) walk.scale *= radiance_scale(event.eta);
    PathRay start = path_from(found.hit, walk.ray.direction);
    start.medium = walk.ray.medium;
    if (has_specular != 0u && !is_diffuse) start = path_after(walk.ray, found, event);
    if (has_rough != 0u && is_vertex) walk.rough = rough_vertex(walk.ray, found, event);
    walk.ray = start;
    if (is_vertex) walk.vertex = start;
    walk.is_straight = is_vertex;
    walk.glints = 0u;
    walk.normal = found.normal;
    walk.vertices += is_vertex ? 1u : 0u;
    ++walk.surfaces;
    float survival = walk.surfaces > min_surfaces ? roulette_survival(walk.throughput) : 1.0;
    bool goes_on = u < survival && max(walk.throughput.x, max(walk.throughput.y, walk.throughput.z)) > 0.0;
    walk.throughput /= goes_on ? survival : 1.0;
    return goes_on;
}

// Aims at an emitter. False where it cannot send light to this point.
bool leave_to_emitter(inout Walk walk) {
    vec3 u = numbers_of(walk, kUseEmitter);
    vec3 u_point = numbers_of(walk, kUseEmitterPoint);
    vec3 origin = local_position(walk.vertex.cell, walk.vertex.fraction);
    LightSample aim = aim_at_emitter(origin, unit_bits(u.x), u.y, u_point.xy);
    set_direction(walk, aim.direction);
    if (!(aim.pdf > 0.0 && walk.pdf > 0.0)) return false;
    walk.emitter = aim.emitter;
    walk.expected = aimed_throughput(walk) * (walk.scale * walk.pdf / aim.pdf);
    return true;
}

// Aims at a texel of an image of the sky. False where that is below the horizon of the surface.
bool leave_to_sky(inout Walk walk) {
    SampleKey key = sample_of_frame;
    key.stream = walk.stream;
    SkyImageSample aim = sample_sky_image(sky_numbers(key, walk.surfaces));
    set_direction(walk, aim.direction);
    float weight = balance_weight(aim.pdf, walk.pdf);
    walk.expected = aimed_throughput(walk) * aim.radiance * (walk.scale * weight * walk.pdf / aim.pdf);
    return walk.pdf > 0.0;
}

// Aims at the sun, or at one of its images. False where that is below the horizon of the surface. Rough glass
// aims at the sun itself, on the side that is in air.
bool leave_to_sun(inout Walk walk, uint use) {
    vec3 u = numbers_of(walk, use);
    bool is_in_glass = has_glass_voxels != 0u && walk.vertex.medium != kNoMedium && !is_off_rough_glass(walk);
    if (is_in_glass && use == kUseSun) return false;
    uint image = use == kUseSun ? 0u : 1u + min(uint(u.z * float(kImages - 1u)), kImages - 2u);
    GlassImage glass_image = draw_glass_image(u.z);
    vec3 direction = uniform_cone(image_direction(is_in_glass ? glass_image.image : image), sun_height, u.xy);
    if (is_in_glass) direction = across_face(direction, glass_image.axis, material_ior(walk.vertex.medium));
    set_direction(walk, direction);
    walk.expected = aimed_throughput(walk) * sun_irradiance * (walk.scale * walk.pdf);
    return walk.pdf > 0.0 && (!is_off_rough_glass(walk) || walk.ray.medium == kNoMedium);
}

// Samples the direction of the path's own ray.
void leave_by_chance(inout Walk walk) {
    vec3 u = numbers_of(walk, kUseDirection);
    if (!is_off_rough(walk)) {
        set_direction(walk, walk.vertices == 1u ? walk.ahead : cosine_about(walk.normal, u.xy));
        return;
    }
    if (walk.starts_rough && walk.vertices == 2u) u.xy = walk.first.xy;
    vec3 direction = sample_rough(walk.rough.outward, walk.normal, walk.rough.alpha, walk.rough.eta, u);
    bool is_sent = direction != vec3(0.0);
    set_direction(walk, is_sent ? direction : walk.normal);
    walk.throughput *= is_sent ? walk.gain : vec3(0.0);
    walk.scale *= walk.bend;  // apart from what roulette looks at
}

// For Walk::image_share.
float samples_of_ray(Walk walk) {
    if (!is_off_rough_glass(walk)) return samples_of_sun(walk.ray.direction, walk.vertex.medium);
    return walk.ray.medium == kNoMedium && is_in_cone(walk.ray.direction, sun_direction, sun_reach) ? 1.0 : 0.0;
}

// Starts the next ray of a diffuse surface. `last` is the kind of the previous one, kRayNone before the
// first. At the visible point other passes aim at sun and emitters.
void leave(inout Walk walk, uint last) {
    bool is_first = walk.vertices == 1u;
    bool has_image = has_glints && has_images != 0u && !is_off_rough_glass(walk);
    walk.kind = kRayOn;
    walk.is_straight = !(is_first && walk.vertex.medium != kNoMedium);  // in glass only the path finds light
    walk.glints = 0u;
    bool may_see_sun = has_sun != 0u && (has_glints || !is_first);
    if (may_see_sun && last == kRayNone && leave_to_sun(walk, kUseSun)) walk.kind = kRaySun;
    if (has_image && last <= kRaySun && walk.kind == kRayOn && leave_to_sun(walk, kUseImage)) walk.kind = kRayImage;
    bool may_aim = has_emitters != 0u && aims_at_emitters != 0u && !is_first;
    if (may_aim && last < kRayEmitter && walk.kind == kRayOn && leave_to_emitter(walk)) walk.kind = kRayEmitter;
    if (aims_at_sky != 0u && last < kRaySky && walk.kind == kRayOn && leave_to_sky(walk)) walk.kind = kRaySky;
    if (walk.kind == kRayOn) leave_by_chance(walk);
    if (has_glints) walk.image_share = 1.0 / (samples_of_ray(walk) + cone_solid_angle(sun_height) * walk.pdf);
}

#endif
