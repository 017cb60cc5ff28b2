#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Light of an atmosphere. For a ray that leaves the scene: the radiance of the sky there. For a hit:
// irradiance / pi from the sky, by rays that meet nothing within the occlusion radius, and its visibility,
// the fraction of cosine-distributed rays that do not. Rays from voxels are drawn in proportion to the light
// that an unoccluded face receives; rays from spheres are cosine-distributed.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/occlusion.glsl"
#include "lib/sky_seen.glsl"

VX_SPECIALIZED(uint, hits_stride, 1u);

layout(scalar) readonly buffer SkyShares {
    float sky_shares[];
};

float load_share(uint i) {
    return sky_shares[i];
}

#define VX_SAMPLE_PARAM
#define VX_SAMPLE_ARG
#include "shared/sky_sample.h"

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) writeonly buffer Ao {
    float ao[];
};
layout(scalar) writeonly buffer SkyLight {
    vec3 sky_light[];
};

struct SkyRay {
    vec3 direction;
    float weight;  // mean factor of its radiance, over pi
};

SkyRay sky_ray(Hit hit, vec2 u) {
    SkyRay ray;
    if (is_on_sphere(hit)) {
        ray.direction = cosine_off(hit, u);
        ray.weight = 1.0;
        return ray;
    }
    SkySample drawn = sample_sky(hit.face, u);
    ray.direction = drawn.direction;
    ray.weight = max(dot(drawn.direction, face_normal(hit.face)), 0.0) * kInversePi / drawn.pdf;
    return ray;
}

void main() {
    init_scene();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index * hits_stride];
    bool is_lit = is_surface(hit) && hit.face != kFaceInside;
    vec3 light = vec3(0.0);
    float open = 0.0;
    if (is_lit) {
        uint own = own_sphere(hit);
        uint stream = pixel_stream(pixel);
        uvec2 first = first_ray(frame.sample_index, ao_rays);
        for (uint i = 0u; i < ao_rays; ++i) {
            SkyRay ray = sky_ray(hit, occlusion_point(stream, ray_number(first, i)));
            if (ray.weight <= 0.0 || is_occluded(ray_from(hit, ray.direction, frame.ao_radius), own)) continue;
            light += ray.weight * sky_along(ray.direction, pixel_key(pixel), 1u + i);
            open += ray.weight;
        }
        light /= float(ao_rays);
    } else if (!is_surface(hit)) {
        light = seen_sky(pixel, hit);
    }
    count(kWorkAoRays, is_lit ? ao_rays : 0u);
    ao[pixel.index] = is_lit ? open / float(ao_rays) : (hit.face == kFaceInside ? 0.0 : 1.0);
    sky_light[pixel.index] = light;
}
