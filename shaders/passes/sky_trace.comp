#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Light of an atmosphere, or of an image of the sky. For a ray that leaves the scene: the radiance of the sky
// there. For a hit: irradiance / pi from the sky, by rays that meet nothing within the occlusion radius, and
// its visibility, the fraction of cosine-distributed rays that do not. Rays from voxels are drawn in
// proportion to the light that an unoccluded face receives; rays from spheres are cosine-distributed. Under
// an image, half of the rays are, and the others are drawn in proportion to its light; each counts by the
// mean density of both, which is the balance heuristic (Veach and Guibas 1995).

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
#include "shared/light.h"
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

SkyRay image_ray(Hit hit, vec2 u, SkyNumbers numbers) {
    bool aims = u.x >= 0.5;
    vec3 aimed = sample_sky_image(numbers).direction;
    SkyRay ray;
    ray.direction = aims ? aimed : cosine_off(hit, vec2(2.0 * u.x, u.y));
    float cosine_pdf = max(dot(ray.direction, surface_normal(hit)), 0.0) * kInversePi;
    float image_pdf = sky_image_along(ray.direction).w;
    ray.weight = cosine_pdf > 0.0 ? 2.0 * balance_weight(cosine_pdf, image_pdf) : 0.0;
    return ray;
}

SkyRay sky_ray(Hit hit, vec2 u, SkyNumbers numbers) {
    if (has_sky_image) return image_ray(hit, u, numbers);
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
    init_sky_image();
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
            vec2 u = occlusion_point(stream, ray_number(first, i));
            SkyRay ray = sky_ray(hit, u, sky_numbers(pixel_key(pixel), i));
            if (ray.weight <= 0.0 || is_occluded(ray_from(hit, ray.direction, frame.ao_radius), own)) continue;
            light += ray.weight * sky_from(ray.direction, pixel_key(pixel), 1u + i);
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
