#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Light that reaches each visible point by way of other surfaces, and the sky's: the mean radiance over the
// cosine-weighted hemisphere, irradiance / pi, on top of what its start holds. One path for each pixel. An invocation
// traces many of them, ray by ray in one loop, so that those that end early do not wait for the others. Where its loops
// have turned too often it goes on in the next round.

#include "lib/address.glsl"

#extension GL_KHR_shader_subgroup_arithmetic : require

#define VX_PUSH PathPush push;
#include "lib/invocation.glsl"

#include "lib/path.glsl"

#include "lib/lights.glsl"

#include "lib/loops.glsl"
#include "lib/path_walk.glsl"
#include "lib/photon_start.glsl"

VX_SPECIALIZED(uint, has_rounds, 0u);  // paths go on from States

layout(scalar) writeonly buffer Light {
    vec3 light[];
};
layout(scalar) buffer States {
    PathState states[];
};

// Whether the ray may be followed to what it has met.
bool is_met(Walk walk, PathHit found) {
    bool is_sound = found.hit.face != kFaceInside || found.stays;
    return is_surface(found.hit) && is_sound && walk.surfaces < kMaxPathSurfaces;
}

void main() {
    init_scene();
    init_walks();
    uint lane = linear_id();
    if (lane >= push.lanes) return;
    uint pixels = frame.column_count * frame.row_count;
    Walk walk = no_walk();
    uint next_id = lane;
    if (has_rounds != 0u && states[lane].next_id != 0u) {
        walk = walk_of(states[lane]);
        next_id = states[lane].next_id;
    }
    uint turns = 0u;
    uint segments = 0u;
    uint too_long = 0u;
    for (uint step = 0u; step < kRoundTurns; ++step) {
        if (walk.kind <= kRayOn && turns > kRoundTurns) break;
        if (walk.kind == kRayNone) {
            if (next_id >= pixels) break;
            walk = first_walk(photon_start(next_id));
            next_id += push.lanes;
        }
        PathHit found = next_hit(walk.ray);
        ++segments;
        turns += 2u + subgroupMax(march_steps) + sphere_turns;
        take_light(walk, found);
        bool arrives = walk.kind == kRayOn;
        bool goes_on = !arrives || is_met(walk, found);
        too_long += arrives && walk.surfaces == kMaxPathSurfaces ? 1u : 0u;
        if (arrives && goes_on) goes_on = scatter(walk, found);
        if (goes_on && walk.is_straight) leave(walk, arrives ? kRayNone : walk.kind);
        if (!goes_on) {
            light[next_id - push.lanes] = walk.light;
            walk.kind = kRayNone;
        }
    }
    if (has_rounds != 0u) states[lane] = state_of(walk, next_id);
    // What is left after the last round is lost.
    uint left = (walk.kind == kRayNone ? 0u : 1u) + (next_id < pixels ? 1u : 0u);
    count(kWorkPathSegments, segments);
    count(kFaultPathTooLong, too_long + left * push.is_last);
    count(kFaultLoopCut, are_loops_spent(2u + (segments & 1u)) ? 1u : 0u);
}
