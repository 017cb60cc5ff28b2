#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Light that reaches each visible point from the sky, by way of other surfaces, and from emitters that the
// path's first ray hits: the mean radiance over the cosine-weighted hemisphere, irradiance / pi. One path per
// pixel. An invocation traces many paths, ray by ray in one loop, so that those that end early do not wait
// for the others. When its loops have used up their turns it goes on in the next round.

#include "lib/address.glsl"

#extension GL_KHR_shader_subgroup_arithmetic : require

#define VX_PUSH PathPush push;
#include "lib/invocation.glsl"

#include "lib/path.glsl"

#include "lib/lights.glsl"

#include "lib/loops.glsl"
#include "lib/path_walk.glsl"
#include "lib/path_start.glsl"

VX_SPECIALIZED(uint, direct_stride, 0u);
VX_SPECIALIZED(uint, has_rounds, 0u);  // paths continue from States

layout(r32ui) readonly uniform uimageBuffer Direct;
layout(scalar) writeonly buffer Light {
    vec3 light[];
};
layout(scalar) buffer States {
    PathState states[];
};

// Direct light of emitters that direct.trace has found at the visible point.
vec3 direct_light(uint i) {
    uvec3 words = uvec3(0u);
    if (direct_stride != 0u) {
        for (uint k = 0u; k < 3u; ++k)
            words[k] = imageLoad(Direct, int(3u * i + k)).x;
    }
    return uintBitsToFloat(words);
}

// Whether the path can continue at what the ray has hit.
bool is_met(Walk walk, PathHit found) {
    bool is_sound = found.hit.face != kFaceInside || found.stays;
    return is_surface(found.hit) && is_sound && walk.surfaces + walk.glints < kMaxPathSurfaces;
}

void main() {
    init_scene();
    init_walks();
    uint lane = linear_id();
    if (lane >= push.lanes) return;
    uint end = frame.first_element + frame.column_count * frame.row_count;  // after the tile's last pixel
    Walk walk = no_walk();
    uint next_id = frame.first_element + lane;
    if (has_rounds != 0u && states[lane].next_id != 0u) {
        next_id = states[lane].next_id;
        if (next_id >= end && states[lane].kind == kRayNone) return;  // an earlier round has ended its paths
        walk = walk_of(states[lane]);
    }
    uint turns = 0u;
    uint segments = 0u;
    uint too_long = 0u;
    for (uint step = 0u; step < kRoundTurns; ++step) {
        if (walk.kind <= kRayOn && turns > kRoundTurns) break;
        if (walk.kind == kRayNone) {
            if (next_id >= end) break;
            walk = first_walk(path_start(next_id), direct_light(next_id));
            bool may_aim = (has_glints || aims_at_sky != 0u) && !walk.starts_rough;
            if (may_aim && walk.throughput.x > 0.0) leave(walk, kRayNone);
            next_id += push.lanes;
        }
        PathHit found = next_hit(walk.ray);
        ++segments;
        take_light(walk, found);
        uint last = walk.kind;
        bool is_own = last == kRayOn;
        bool meets = is_met(walk, found);
        too_long += walk.surfaces + walk.glints == kMaxPathSurfaces ? 1u : 0u;
        vec3 u = numbers_of(walk, is_own ? kUseEvent : kUseGlint);
        BsdfSample event = event_at(walk, found, u.xy);
        turns += 2u + subgroupMax(march_steps) + (has_sphere_tree ? subgroupMax(tree_steps) : 0u);
        bool is_sent = has_glints && (last == kRaySun || last == kRayImage) && meets && glint(walk, found, event);
        bool goes_on = !is_own || (meets && scatter(walk, found, event, u.z));
        if (goes_on && !is_sent && (!is_own || walk.is_straight)) leave(walk, is_own ? kRayNone : last);
        if (!goes_on) {
            light[next_id - push.lanes] = walk.light;
            walk.kind = kRayNone;
        }
    }
    if (has_rounds != 0u) states[lane] = state_of(walk, next_id);
    // What is left after the last round is lost.
    uint left = 0u;
    if (walk.kind != kRayNone) {
        light[next_id - push.lanes] = walk.light;
        ++left;
    }
    for (; push.is_last != 0u && next_id < end; next_id += push.lanes) {
        light[next_id] = direct_light(next_id);
        ++left;
    }
    count(kWorkPathSegments, segments);
    count(kFaultPathTooLong, too_long + left * push.is_last);
    count(kFaultLoopCut, are_loops_spent(2u + (segments & 1u)) ? 1u : 0u);
}
