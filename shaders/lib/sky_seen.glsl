// What a ray that leaves the scene sees of an atmosphere. Include lib/surface.glsl first.
#ifndef VX_SKY_SEEN_GLSL
#define VX_SKY_SEEN_GLSL

#include "lib/sky.glsl"

// Hits of rays that mirrors and glass may have turned: a miss holds its direction.
VX_SPECIALIZED(uint, misses_have_direction, 0u);

// The sun's disc included.
vec3 seen_sky(Pixel pixel, Hit miss) {
    vec3 direction = misses_have_direction != 0u ? miss.fraction : camera_ray_of(pixel).direction;
    return sky_along(direction, pixel_key(pixel), 0u) + sun_disc_radiance(sky, direction);
}

#endif
