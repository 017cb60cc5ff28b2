// What a sample found at the pixels of a group, and the radiance that follows. Radiance is emission plus, at
// Lambertian surfaces, the light of the sky (a constant sky through ambient occlusion), the sun, the emitters
// and photons. An effect that is off is a constant of stride 0.
#ifndef VX_FILM_GROUP_GLSL
#define VX_FILM_GROUP_GLSL

#include "lib/constants.glsl"
#include "lib/frame_access.glsl"
#include "lib/materials.glsl"
#include "lib/spheres.glsl"
#include "lib/texel_planes.glsl"
#include "shared/limits.h"

VX_SPECIALIZED(uint, hits_stride, 1u);
VX_SPECIALIZED(uint, ao_stride, 1u);
VX_SPECIALIZED(uint, sky_stride, 0u);  // 0: the sky is constant
VX_SPECIALIZED(uint, paths_find_sky, 0u);  // at surfaces, instead of ambient occlusion
VX_SPECIALIZED(uint, sun_stride, 1u);
VX_SPECIALIZED(uint, direct_stride, 1u);
VX_SPECIALIZED(uint, photons_stride, 1u);
VX_SPECIALIZED(uint, weights_stride, 1u);
VX_SPECIALIZED(uint, aerial_stride, 0u);  // 0: the air before surfaces is left out
VX_SPECIALIZED(uint, has_emission, 1u);

layout(rgba32ui) readonly uniform uimageBuffer Hits;
layout(rgba32ui) readonly uniform uimageBuffer Ao;
layout(rgba32ui) readonly uniform uimageBuffer SkyLight;
layout(rgba32ui) readonly uniform uimageBuffer Sun;
layout(rgba32ui) readonly uniform uimageBuffer Direct;
layout(rgba32ui) readonly uniform uimageBuffer Photons;
layout(rgba32ui) readonly uniform uimageBuffer Weights;
layout(rgba32ui) readonly uniform uimageBuffer AerialLight;

// 0 for a miss, whose material is undefined.
uint material_of(Hit hit) {
    return is_surface(hit) ? hit.material : 0u;
}

// What the film needs of the pixels of a group. Those outside the tile add nothing.
struct Group {
    bool inside[kGroupPixels];
    Hit hits[kGroupPixels];
    vec3 albedo[kGroupPixels];
    vec3 weights[kGroupPixels];
    vec3 photons[kGroupPixels];
    vec3 sky[kGroupPixels];  // radiance of misses; irradiance / pi at hits
    vec4 ao;
    vec4 sun;
    vec3 direct[kGroupPixels];
    vec3 air[kGroupPixels];  // what the air before hits adds
};

// Sets the hits and loads their materials. Pixels outside count as misses.
void set_hits(inout Group group, Hit hits[kGroupPixels]) {
    for (uint k = 0u; k < kGroupPixels; ++k) {
        if (!group.inside[k]) hits[k].face = kFaceMiss;
        group.albedo[k] = material_albedo(material_of(hits[k]));
    }
    group.hits = hits;
}

// The factor on the light of a constant sky.
float ambient_visibility(Group group, uint k) {
    if (!is_surface(group.hits[k])) return 1.0;
    return paths_find_sky != 0u ? 0.0 : group.ao[k];
}

// Loads group `at` of the tile, whose pixels have the indices from `first` to `end` - 1 in its planes.
Group load_group(uint at, uint first, uint end) {
    Group group;
    for (uint k = 0u; k < kGroupPixels; ++k) {
        uint pixel = kGroupPixels * at + k;
        group.inside[k] = pixel >= first && pixel < end;
    }
    Hit hits[kGroupPixels] = VX_GROUP_HITS(Hits, at, hits_stride);
    set_hits(group, hits);
    group.ao = VX_GROUP_FLOATS(Ao, at, ao_stride);
    if (sky_stride != 0u) {
        group.sky = VX_GROUP_VECTORS(SkyLight, at, sky_stride);
    } else {
        for (uint k = 0u; k < kGroupPixels; ++k)
            group.sky[k] = frame.sky_radiance * ambient_visibility(group, k);
    }
    group.sun = VX_GROUP_FLOATS(Sun, at, sun_stride);
    group.direct = VX_GROUP_VECTORS(Direct, at, direct_stride);
    group.photons = VX_GROUP_VECTORS(Photons, at, photons_stride);
    group.weights = VX_GROUP_VECTORS(Weights, at, weights_stride);
    if (aerial_stride != 0u) {
        group.air = VX_GROUP_VECTORS(AerialLight, at, aerial_stride);
    }
    return group;
}

vec3 radiance(Group group, uint k) {
    Hit hit = group.hits[k];
    vec3 radiance = group.sky[k];
    if (is_surface(hit)) {
        vec3 sunlight = frame.sun_irradiance * (group.sun[k] * kInversePi);
        vec3 emitter_light = group.direct[k] + kInversePi * group.photons[k];
        vec3 emission = has_emission != 0u ? material_emission(material_of(hit)) : vec3(0.0);
        if (hit.face == kFaceSphereInside) emission = vec3(0.0);
        radiance = emission + group.albedo[k] * (group.sky[k] + sunlight + emitter_light);
    }
    radiance *= group.weights[k];
    return aerial_stride != 0u ? radiance + group.air[k] : radiance;
}

#endif
