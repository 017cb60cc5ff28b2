#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Draws the first direction, cosine-distributed, of the path of each visible point. A pass of its own,
// because software devices would otherwise run through this code in every turn of the loop of path_trace.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/hits.glsl"
#include "lib/path.glsl"
#include "lib/path_start.glsl"

VX_SPECIALIZED(uint, finds_media, 0u);  // visible points may be inside glass voxels

uint medium_at(Ray ray) {
    ray.t_max = kProbeLength;
    WorldEntry entry = enter_world(ray, frame.chunks << kChunkLog2);
    if (!entry.enters) return kNoMedium;
    MarchHit met = march(entry.ray, frame.chunks);
    count(kFaultRayUnsound, met.fault == kMarchUnsound ? 1u : 0u);
    return met.face == kFaceInside && is_glass(met.material) ? met.material : kNoMedium;
}

void main() {
    init_world();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    if (has_rough != 0u && starts_rough(pixel.index)) return;  // specular_trace has found it
    Hit hit = load_hit(pixel.index);
    PathStart start;
    start.cell = ivec3(-1);
    start.fraction = vec3(0.5);
    start.direction = vec3(0.0);
    start.normal = vec3(0.0, 0.0, 1.0);
    start.own = kNoSphere;
    start.medium = kNoMedium;
    start.stream = pixel_stream(pixel);
    start.is_rough = 0u;
    if (is_surface(hit) && hit.face != kFaceInside) {
        vec2 u = draw_2d(pixel_key(pixel), kPairPath);
        start.normal = surface_normal(hit);
        Ray ray = ray_from(hit, cosine_about(start.normal, u), kUnbounded);
        start.cell = ray.cell;
        start.fraction = ray.fraction;
        start.direction = ray.direction;
        start.own = own_sphere(hit);
        if (finds_media != 0u) start.medium = medium_at(ray);
    }
    put_path_start(pixel.index, start);
}
