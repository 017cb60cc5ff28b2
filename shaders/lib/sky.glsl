// The sky of an atmosphere, as sky.view left it, or by paths through the air.
#ifndef VX_SKY_GLSL
#define VX_SKY_GLSL

#include "lib/sky_params.glsl"
#include "shared/sky_path.h"

layout(scalar) readonly buffer SkyView {
    vec3 sky_view[];
};

vec3 load_view(uint i) {
    return sky_view[i];
}

#define VX_VIEW_PARAM
#define VX_VIEW_ARG
#include "shared/sky_lookup.h"

// Radiance that comes from a unit direction, the sun's disc left out. `number`: of the path through the air among those of
// the sample.
vec3 sky_along(vec3 direction, SampleKey key, uint number) {
    return traces_air != 0u ? traced_sky(sky, direction, air_noise(key, number)) : sky_radiance(sky, direction);
}

#endif
