// Hits, spheres, and rays that start at a surface.
#ifndef VX_SURFACE_GLSL
#define VX_SURFACE_GLSL

#include "lib/constants.glsl"
#include "lib/frame_access.glsl"
#include "lib/samples.glsl"
#include "lib/sphere_tree.glsl"
#include "lib/spheres.glsl"
#include "lib/counters_access.glsl"
#include "lib/world_access.glsl"
#include "shared/sampling.h"

VX_SPECIALIZED(uint, has_voxels, 1u);

// Position relative to the world's corner, voxels.
vec3 local_position(ivec3 cell, vec3 fraction) {
    return vec3(cell) + fraction;
}

// Prepares the world and the spheres for rays. Call it at the start of main(), while all invocations are
// active.
void init_scene() {
    init_world();
    if (sphere_count != 0u && sphere_count <= kFewSpheres) load_spheres();
}

uint tree_steps = 0u;  // of the last ray

// The first sphere that a ray crosses before t_max; of a ray that `takes_any`, maybe a later one. `own` is the
// sphere that the ray starts on.
NearestSphere found_sphere(vec3 origin, vec3 direction, float t_max, uint own, bool takes_any) {
    NearestSphere nearest;
    nearest.i = kNoSphere;
    nearest.t = t_max;
    nearest.steps = 0u;
    if (has_sphere_tree) {
        nearest = nearest_in_tree(origin, direction, t_max, own, takes_any);
        tree_steps = nearest.steps;
    } else {
        for (uint i = 0u; i < sphere_count; ++i) {
            float t = sphere_time(held_spheres[i].shape, origin, direction, nearest.t, i == own);
            nearest.i = t < nearest.t ? i : nearest.i;
            nearest.t = t;
        }
    }
    return nearest;
}

NearestSphere nearest_sphere(vec3 origin, vec3 direction, float t_max, uint own) {
    return found_sphere(origin, direction, t_max, own, false);
}

// A point of the ground without rounding error, clamped to the range of cell coordinates.
vec3 on_ground(vec3 position, float height) {
    vec2 place = clamp(position.xy, vec2(-kFarthestGround), vec2(kFarthestGround));
    return vec3(place, height);
}

// Makes a hit of the crossing with sphere `i` at hit.t. Returns the normal on the side that was hit.
vec3 place_on_sphere(inout Hit hit, uint i, SphereRecord sphere, vec3 origin, vec3 direction) {
    vec3 position = origin + hit.t * direction;
    if (has_ground != 0u && i == sphere_count - 1u) position = on_ground(position, sphere.shape.anchor.z);
    vec3 corner = floor(position);
    hit.cell = ivec3(corner);
    hit.fraction = clamp(position - corner, vec3(0.0), vec3(1.0));
    vec3 outward = sphere_normal(sphere.shape, position);
    bool leaves = dot(outward, direction) > 0.0;
    hit.face = leaves ? kFaceSphereInside : kFaceSphere;
    hit.material = sphere.material;
    hit.sphere = i;
    return leaves ? -outward : outward;
}

// A ray from the surface of a hit. `direction` points away from the surface.
Ray ray_from(Hit hit, vec3 direction, float t_max) {
    if (is_on_sphere(hit)) {
        Ray ray;
        ray.cell = hit.cell;
        ray.fraction = hit.fraction;
        ray.direction = direction;
        ray.t_max = t_max;
        return ray;
    }
    return spawn_ray(hit.cell, hit.face, hit.fraction, direction, t_max);
}

bool hits_voxels(Ray ray) {
    if (has_voxels == 0u) return false;
    if (sphere_count != 0u) {  // only rays off a sphere can start outside the world
        WorldEntry entry = enter_world(ray, frame.chunks << kChunkLog2);
        if (!entry.enters) return false;
        ray = entry.ray;
    }
    MarchHit hit = march(ray, frame.chunks);
    count(kFaultRayUnsound, hit.fault == kMarchUnsound ? 1u : 0u);
    count(kFaultMarchExhausted, hit.fault == kMarchExhausted ? 1u : 0u);
    return hit.face != kFaceMiss;
}

// `own` is the sphere on which the ray starts.
bool hits_spheres(Ray ray, uint own) {
    if (sphere_count == 0u) return false;
    vec3 origin = local_position(ray.cell, ray.fraction);
    return found_sphere(origin, ray.direction, ray.t_max, own, true).i != kNoSphere;
}

bool is_occluded(Ray ray, uint own) {
    return hits_voxels(ray) || hits_spheres(ray, own);
}

#endif
