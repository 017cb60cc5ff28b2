#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Traces photons from surface to surface and stores them where diffuse surfaces receive them, except for
// direct light of emitters, which direct.trace finds. An invocation traces several photons, surface by
// surface in one loop, so that those that end early do not wait for the others.

#include "lib/address.glsl"

#include "lib/invocation.glsl"
#include "lib/path.glsl"
#include "lib/loops.glsl"
#include "lib/photon_start.glsl"
#include "lib/photon_store.glsl"

VX_SPECIALIZED(uint, keeps_caustics, 1u);  // light that has met mirrors and glass only
VX_SPECIALIZED(uint, keeps_indirect, 1u);  // light that has met a diffuse surface
VX_SPECIALIZED(uint, sends_caustics_on, 0u);  // of indirect light, only what has met mirrors or glass first
VX_SPECIALIZED(uint, lanes, 1u);           // invocations
VX_SPECIALIZED(uint, depth_limit, 0u);     // surfaces that a photon hits; 0: roulette ends its path

struct Photon {
    PathRay path;
    vec3 power;       // at the start
    vec3 throughput;  // since then
    NoiseStream noise;
    uint bounces;       // surfaces
    bool has_passed;    // a border of glass without a surface, where shadow rays end
    bool is_scattered;  // by a diffuse surface
    bool is_caustic;    // mirrors or glass came first
};

Photon start_photon(uint place, uint id) {
    PhotonStart start = photon_start(place);
    Photon photon;
    photon.path.cell = start.cell;
    photon.path.fraction = start.fraction;
    photon.path.direction = start.direction;
    photon.path.own = start.sphere;
    photon.path.medium = kNoMedium;
    photon.power = start.power;
    photon.throughput = vec3(1.0);
    photon.noise.state = start.noise;
    photon.noise.increment = 2u * id + 1u;
    photon.bounces = 0u;
    photon.has_passed = false;
    photon.is_scattered = false;
    photon.is_caustic = false;
    return photon;
}

float draw(inout Photon photon) {
    float u = stream_float(photon.noise);
    photon.noise = stream_after(photon.noise);
    return u;
}

vec2 draw_pair(inout Photon photon) {
    float u = draw(photon);
    return vec2(u, draw(photon));
}

// Continues the photon at what it has hit. False where it ends.
bool bounce(inout Photon photon, PathHit found) {
    BsdfSample event = path_event(photon.path, found, draw_pair(photon));
    PathRay next = path_after(photon.path, found, event);
    bool is_diffuse = event.kind == kEventDiffuse;
    if (!photon.is_scattered) photon.is_caustic = photon.bounces > 0u || photon.has_passed;
    bool goes_on = keeps_indirect != 0u || (sends_caustics_on != 0u && photon.is_caustic);
    bool is_kept = photon.is_scattered ? goes_on : photon.is_caustic && keeps_caustics != 0u;
    bool sends = max(event.albedo.x, max(event.albedo.y, event.albedo.z)) > 0.0;
    if (is_diffuse && is_kept && sends)
        store_photon(photon_position(found.hit), photon_surface(found.hit), photon.power * photon.throughput);
    PathRay off_surface = path_from(found.hit, cosine_about(found.normal, draw_pair(photon)));
    off_surface.medium = photon.path.medium;
    if (is_diffuse) next = off_surface;
    photon.is_scattered = photon.is_scattered || is_diffuse;
    photon.path = next;
    photon.has_passed = photon.has_passed || event.kind == kEventPass;
    if (event.kind == kEventPass) return true;
    photon.throughput *= event.albedo;
    float survival = depth_limit == 0u ? roulette_survival(photon.throughput) : 1.0;
    bool survives = draw(photon) < survival && (goes_on || !is_diffuse);
    photon.throughput /= survives ? survival : 1.0;
    ++photon.bounces;
    return survives && (depth_limit == 0u || photon.bounces < depth_limit);
}

void main() {
    init_photons();
    init_scene();
    uint lane = linear_id();
    if (lane >= lanes) return;
    PhotonParams run = photon;
    uint next_place = lane;
    uint segments = 0u;
    uint passes = 0u;
    uint too_long = 0u;
    bool is_alive = false;
    Photon photon;
    for (uint step = 0u; step < kMaxPhotonSteps; ++step) {
        if (!is_alive) {
            if (next_place >= run.photons) break;
            photon = start_photon(next_place, run.first_photon + next_place);
            next_place += lanes;
            passes = 0u;
        }
        PathHit found = next_hit(photon.path);
        ++segments;
        ++passes;
        too_long += passes == kMaxBounces ? 1u : 0u;
        is_alive = is_surface(found.hit) && (found.hit.face != kFaceInside || found.stays) && passes < kMaxBounces;
        if (is_alive) is_alive = bounce(photon, found);
    }
    close_store();
    count(kWorkPathSegments, segments);
    count(kFaultPathTooLong, too_long);
    count(kFaultLoopCut, are_loops_spent(2u + (segments & 1u)) ? 1u : 0u);
}
