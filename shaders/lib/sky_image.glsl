// An image of the sky (shared/sky_image.h), and rays towards it. Include lib/frame_access.glsl first.
#ifndef VX_SKY_IMAGE_GLSL
#define VX_SKY_IMAGE_GLSL

#include "lib/constants.glsl"
#include "shared/alias.h"
#include "shared/dimensions.h"
#include "shared/sky_image.h"

VX_SPECIALIZED(uint, sky_columns, 0u);  // 0: the sky is not an image
VX_SPECIALIZED(uint, sky_rows, 0u);

// Texels, because lavapipe loads them for eight invocations at once (lab/notes/film.md).
layout(rgba32ui) readonly uniform uimageBuffer SkyTexels;  // radiance, and the pdf per steradian of sample_sky_image
layout(r32ui) readonly uniform uimageBuffer SkyTable;      // kAliasWords per AliasEntry

const bool has_sky_image = sky_columns != 0u;

// A copy of the frame's value, because lavapipe would load it anew in every turn of a loop (shaders/README.md).
float sky_turn;

void init_sky_image() {
    sky_turn = frame.sky_turn;
}

SkyGrid sky_grid() {
    SkyGrid grid;
    grid.columns = sky_columns;
    grid.rows = sky_rows;
    grid.turn = sky_turn;
    return grid;
}

// Radiance, and the density with which sample_sky_image() draws each direction of the texel.
vec4 sky_texel_light(uint texel) {
    return uintBitsToFloat(imageLoad(SkyTexels, int(texel)));
}

vec4 sky_image_along(vec3 direction) {
    return sky_texel_light(sky_texel(sky_grid(), direction));
}

struct SkyImageSample {
    vec3 direction;
    vec3 radiance;
    float pdf;  // per steradian
};

SkyImageSample sample_sky_image(SkyNumbers u) {
    uint texels = sky_columns * sky_rows;
    uint bucket = min(alias_bucket(u.bits, texels), texels - 1u);
    AliasEntry entry;
    entry.keep = uintBitsToFloat(imageLoad(SkyTable, int(kAliasWords * bucket)).x);
    entry.other = imageLoad(SkyTable, int(kAliasWords * bucket + 1u)).x;
    uint texel = alias_choice(entry, bucket, u.choice);
    vec4 light = sky_texel_light(texel);
    SkyImageSample drawn;
    drawn.direction = sky_direction(sky_grid(), texel, u.place);
    drawn.radiance = light.xyz;
    drawn.pdf = light.w;
    return drawn;
}

#endif
