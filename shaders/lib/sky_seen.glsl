// The radiance of an atmosphere, or of an image of the sky, for a ray that leaves the scene. Include
// lib/surface.glsl first.
#ifndef VX_SKY_SEEN_GLSL
#define VX_SKY_SEEN_GLSL

#include "lib/sky.glsl"
#include "lib/sky_image.glsl"

// Mirrors and glass may have turned the ray: a miss then holds its direction.
VX_SPECIALIZED(uint, misses_have_direction, 0u);

vec3 sky_from(vec3 direction, SampleKey key, uint number) {
    return has_sky_image ? sky_image_along(direction).xyz : sky_along(direction, key, number);
}

// Includes the sun's disc in an atmosphere.
vec3 seen_sky(Pixel pixel, Hit miss) {
    vec3 direction = misses_have_direction != 0u ? miss.fraction : camera_ray_of(pixel).direction;
    vec3 radiance = sky_from(direction, pixel_key(pixel), 0u);
    return has_sky_image ? radiance : radiance + sun_disc_radiance(sky, direction);
}

#endif
