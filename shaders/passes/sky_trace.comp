#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Light of an atmosphere. For a ray that leaves the scene: the radiance of the sky there. For a hit: the irradiance by
// the sky over pi, the mean of what cosine-distributed rays see that meet nothing within the occlusion radius; and
// their share, its visibility.

#include "lib/address.glsl"

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/occlusion.glsl"
#include "lib/sky_seen.glsl"

VX_SPECIALIZED(uint, hits_stride, 1u);

layout(scalar) readonly buffer Hits {
    Hit hits[];
};
layout(scalar) writeonly buffer Ao {
    float ao[];
};
layout(scalar) writeonly buffer SkyLight {
    vec3 sky_light[];
};

void main() {
    init_scene();
    Pixel pixel = this_pixel();
    if (!pixel.inside) return;
    Hit hit = hits[pixel.index * hits_stride];
    bool is_lit = is_surface(hit) && hit.face != kFaceInside;
    vec3 light = vec3(0.0);
    uint open = 0u;
    if (is_lit) {
        uint own = own_sphere(hit);
        uint stream = pixel_stream(pixel);
        uvec2 first = first_ray(frame.sample_index, ao_rays);
        for (uint i = 0u; i < ao_rays; ++i) {
            vec3 direction = occlusion_direction(hit, stream, ray_number(first, i));
            if (is_occluded(ray_from(hit, direction, frame.ao_radius), own)) continue;
            light += sky_radiance(sky, direction);
            ++open;
        }
        light /= float(ao_rays);
    } else if (!is_surface(hit)) {
        light = seen_sky(pixel, hit);
    }
    count(kWorkAoRays, is_lit ? ao_rays : 0u);
    ao[pixel.index] = is_lit ? float(open) / float(ao_rays) : (hit.face == kFaceInside ? 0.0 : 1.0);
    sky_light[pixel.index] = light;
}
