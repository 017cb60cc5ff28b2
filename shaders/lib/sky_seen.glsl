// The radiance of an atmosphere for a ray that leaves the scene. Include lib/surface.glsl first.
#ifndef VX_SKY_SEEN_GLSL
#define VX_SKY_SEEN_GLSL

#include "lib/sky.glsl"

// Mirrors and glass may have turned the ray: a miss then holds its direction.
VX_SPECIALIZED(uint, misses_have_direction, 0u);

// Includes the sun's disc.
vec3 seen_sky(Pixel pixel, Hit miss) {
    vec3 direction = misses_have_direction != 0u ? miss.fraction : camera_ray_of(pixel).direction;
    return sky_along(direction, pixel_key(pixel), 0u) + sun_disc_radiance(sky, direction);
}

#endif
