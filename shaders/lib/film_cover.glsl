// How much of a background the scene covers. Include lib/film_group.glsl first; the pass declares FirstHits
// and has_specular.
#ifndef VX_FILM_COVER_GLSL
#define VX_FILM_COVER_GLSL

#include "shared/tone_curve.h"

VX_SPECIALIZED(uint, catches_shadows, 0u);  // the ground is visible only by shadows on it

// In front of a background, camera rays that hit nothing are transparent. A ground that only catches shadows
// is black, with an opacity equal to the fraction of light that it lacks.
vec4 cover(uint at, Group group, inout vec3 color[kGroupPixels]) {
    Hit hits[kGroupPixels] = group.hits;
    if (has_specular != 0u) hits = VX_GROUP_HITS(FirstHits, at, 1u);
    vec4 coverage = vec4(0.0);
    for (uint k = 0u; k < kGroupPixels; ++k) {
        bool is_met = group.inside[k] && is_surface(hits[k]);
        bool is_ground = catches_shadows != 0u && is_met && hits[k].material == frame.ground_material;
        // Without light there is no shadow.
        float lacks =
            frame.ground_luminance > 0.0 ? 1.0 - luminance_of(color[k]) / frame.ground_luminance : 0.0;
        coverage[k] = is_ground ? lacks : (is_met ? 1.0 : 0.0);
        color[k] = is_met && !is_ground ? color[k] : vec3(0.0);
    }
    return coverage;
}

#endif
