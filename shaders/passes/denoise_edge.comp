#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Finds the light of pixels that see several surfaces from the pixels around them, and multiplies light by
// albedo again.

#define VX_GROUP_2D
#include "lib/invocation.glsl"

#include "lib/denoise_planes.glsl"

VX_INPUT(Light);
VX_INPUT(Albedo);
VX_INPUT(Normal);
VX_OUTPUT(Reflected);

void main() {
    ivec2 place = this_place();
    if (!is_inside(place)) return;
    int at = texel_at(place);
    vec4 own = VX_LOAD(Light, at);
    vec4 normal = VX_LOAD(Normal, at);
    bool is_mixed = !is_pure(normal) && own.w > 0.0;
    FeatureFit fit =
        FeatureFit(0.0, vec4(0.0), mat4(0.0), vec3(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    int across = 2 * kDenoiseReach + 1;
    for (int i = 0; i < (is_mixed ? across * across : 0); ++i) {
        ivec2 offset = ivec2(i % across, i / across) - kDenoiseReach;
        ivec2 tap = place + offset;
        bool inside = is_inside(tap);
        int from = inside ? texel_at(tap) : at;
        vec4 light = VX_LOAD(Light, from);
        vec4 surface = VX_LOAD(Normal, from);
        float near = inside ? exp(float(-dot(vec2(offset), vec2(offset))) / 6.0) : 0.0;
        float weight = near * light.w * (is_pure(surface) ? 1.0 : kMixedWeight);
        vec4 feature = features_of(normal, surface);
        fit.weight += weight;
        fit.feature += weight * feature;
        fit.features += outerProduct(weight * feature, feature);
        fit.light += weight * light.xyz;
        fit.red += (weight * light.x) * feature;
        fit.green += (weight * light.y) * feature;
        fit.blue += (weight * light.z) * feature;
    }
    vec3 found = is_mixed && fit.weight > kLeastWeight ? featured_light(fit) : own.xyz;
    VX_STORE(Reflected, at, vec4(VX_LOAD(Albedo, at).xyz * found, own.w));
}
