#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Follows each camera ray through mirrors and glass to the diffuse surface or the sky that is seen there. `t`
// of the result is the total length of the path; at the sky, `fraction` is the direction of the ray.
// Reflection or refraction at glass is drawn anew in each sample. At rough metal and rough glass, the path of the
// pixel finds all light: there the result is a black hit, and the path starts with the ray that has led there.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/path.glsl"

#include "lib/path_start.glsl"
#include "lib/black_hit.glsl"
#include "shared/dimensions.h"

layout(scalar) readonly buffer FirstHits {
    Hit first_hits[];
};
layout(scalar) writeonly buffer Hits {
    Hit hits[];
};
// Factor of the radiance seen there.
layout(scalar) writeonly buffer Weights {
    vec3 weights[];
};

PathHit first_hit(Pixel pixel) {
    PathHit found = no_hit();
    found.hit = first_hits[pixel.index];
    if (!is_surface(found.hit)) return found;
    found.normal = surface_normal(found.hit);
    if (is_on_sphere(found.hit)) found.curvature = spheres[found.hit.sphere].shape.curvature;
    found.far_medium = is_glass(found.hit.material) && !is_on_sphere(found.hit) ? found.hit.material : kNoMedium;
    found.stays = found.hit.face == kFaceInside && found.far_medium != kNoMedium;
    return found;
}

PathRay first_ray(Pixel pixel) {
    Ray ray = camera_ray_of(pixel);
    PathRay path;
    path.cell = ray.cell;
    path.fraction = ray.fraction;
    path.direction = ray.direction;
    path.own = kNoSphere;
    path.medium = kNoMedium;
    return path;
}

// `lobe` is the number that has chosen the lobe of the surface.
void start_before(Pixel pixel, PathRay path, float lobe) {
    PathStart start;
    start.cell = path.cell;
    start.stream = pixel_stream(pixel);
    start.fraction = path.fraction;
    start.own = path.own;
    start.direction = path.direction;
    start.medium = path.medium;
    start.normal = vec3(draw_2d(pixel_key(pixel), kPairPath), lobe);
    start.is_rough = 1u;
    put_path_start(pixel.index, start);
}

void main() {
    init_scene();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    SampleKey key = pixel_key(pixel);
    PathRay path = first_ray(pixel);
    PathHit found = first_hit(pixel);
    vec3 weight = vec3(1.0);
    float length_so_far = found.hit.t;
    uint segments = 0u;
    bool is_open = true;
    if (has_rough != 0u) put_no_rough_start(pixel.index);
    uint bounce = 0u;
    for (; bounce < kMaxBounces; ++bounce) {
        if (!is_surface(found.hit)) break;
        uint pair = kPairBounce + kPairsOfBounce * bounce;
        vec2 u = bounce < kSureBounces ? draw_2d(key, pair) : sample_2d(kSequenceWhite, key, pair);
        BsdfSample event = path_event(path, found, u);
        if (event.kind == kEventDiffuse) break;
        if (has_rough != 0u && event.kind == kEventRough) {
            start_before(pixel, path, u.x);
            found.hit = black_hit(found.hit);
            break;
        }
        if (event.kind != kEventPass) weight *= event.albedo;
        if (event.kind == kEventRefract) weight *= radiance_scale(event.eta);
        if (bounce >= kSureBounces) {
            float survival = roulette_survival(weight);
            is_open = sample_1d(kSequenceWhite, key, 2u * pair + 2u) < survival;
            weight = is_open ? weight / survival : vec3(0.0);
        }
        if (!is_open) break;
        path = path_after(path, found, event);
        found = next_hit(path);
        length_so_far += found.hit.t;
        ++segments;
    }
    count(kWorkPathSegments, segments);
    count(kFaultPathTooLong, bounce == kMaxBounces ? 1u : 0u);
    found.hit.t = length_so_far;
    if (!is_open || bounce == kMaxBounces) found = no_hit();
    if (!is_surface(found.hit)) {
        found.hit.t = 0.0;
        found.hit.fraction = path.direction;
    }
    hits[pixel.index] = found.hit;
    weights[pixel.index] = is_open && bounce < kMaxBounces ? weight : vec3(0.0);
}
