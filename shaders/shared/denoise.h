// The mathematics of the denoiser. The light of a picture that is found by chance is divided by the albedo
// and averaged over pixels of the same plane, in an a-trous scheme (Dammertz et al. 2010, "Edge-Avoiding
// A-Trous Wavelet Transform for fast Global Illumination Filtering"), with a linear fit in place of the mean
// from the second level on. Pixels that see several surfaces are found by first-order regression in features
// instead (Bitterli et al. 2016, "Nonlinearly Weighted First-Order Regression for Denoising Monte Carlo
// Renderings").
//
// Everything is done twice, for each half of the film alone. The halves A and B are independent and without
// bias, so what a filtered half is off shows in the other one. For x and y made of one half,
// E[(x_A - B)(x_A - y_A)] = E[(x_A - I)(x_A - y_A)], I the true value: from this follow without a model the
// best mixture of two filters (share_of) and the squared error of the result (squared_error). Compare
// Rousselle, Knaus and Zwicker 2012, "Adaptive Rendering with Non-Local Means Filtering", for the idea of two
// buffers.
#ifndef VX_DENOISE_H
#define VX_DENOISE_H

#include "limits.h"
#include "portable.h"
#include "tone_curve.h"

VX_BEGIN

VX_CONST(int, kDenoiseReach, 2);      // taps on each side of the centre
VX_CONST(uint, kDenoiseBlock, 16u);   // pixels: edge of the blocks in which mixtures are found
VX_CONST(float, kPureNormal, 0.97f);  // length of a mean normal from which on a pixel sees one plane
VX_CONST(float, kGuideScale, 10.0f);  // 1 / 0.1: squares of differences of normals, and of offsets in voxels
VX_CONST(float, kSlopeRidge, 0.03f);  // of slopes, in squares of a tap's reach
VX_CONST(float, kFeatureRidge, 0.01f);    // of features, whose differences are of the order of 1
VX_CONST(float, kMixedWeight, 0.1f);      // of a pixel that sees several surfaces, where others can be had
VX_CONST(float, kLeastAlbedo, 0.02f);     // of a channel, of the luminance of the albedo
VX_CONST(float, kBlackAlbedo, 1e-6f);     // luminance below which a pixel reflects nothing
VX_CONST(float, kDenoiseEpsilon, 0.01f);  // that of relMSE
VX_CONST(float, kLeastWeight, 1e-30f);    // of a fit, whose inverse is still finite

// Push constants of all passes of the denoiser.
struct DenoisePush {
    ivec2 size;   // pixels
    int step;     // between taps, pixels
    float share;  // of the samples that half A has
};

// Light that falls on a surface over pi, from what it reflects, and the weight of that: the square of the
// albedo, by whose inverse division multiplies the variance.
VX_FN vec4 received_light(vec3 reflected, vec3 albedo) {
    const float brightness = luminance_of(albedo);
    if (brightness < kBlackAlbedo) return vec4(0.0f, 0.0f, 0.0f, 0.0f);
    const vec3 divisor = max(albedo, vec3(kLeastAlbedo * brightness));
    return vec4(reflected / divisor, brightness * brightness);
}

// Unit normal and offset of a pixel that is covered in part: both are means over the samples, misses
// included.
VX_FN vec4 guide_of(vec4 normal_offset) {
    const vec3 normal = vec3(normal_offset.x, normal_offset.y, normal_offset.z);
    const float cover = sqrt(dot(normal, normal));
    return cover > 1e-3f ? normal_offset / cover : normal_offset;
}

VX_FN bool is_pure(vec4 normal_offset) {
    const vec3 normal = vec3(normal_offset.x, normal_offset.y, normal_offset.z);
    return dot(normal, normal) > kPureNormal * kPureNormal;
}

// Weight of a tap by its guide: near exp(-d), and 0 from d = 4 on.
VX_FN float guide_weight(vec4 centre, vec4 tap) {
    const vec4 difference = tap - centre;
    const float t = max(1.0f - 0.25f * kGuideScale * dot(difference, difference), 0.0f);
    return (t * t) * (t * t);
}

// Weight of a tap by its distance in taps on one axis: exp(-d^2 / 2.5).
VX_FN float tap_weight(int offset) {
    const int taps = abs(offset);
    return taps == 0 ? 1.0f : (taps == 1 ? 0.67032f : 0.201897f);
}

// Weighted sums for a mean and a linear fit of light over places in the picture.
struct SlopeFit {
    float weight;
    vec2 place;
    vec3 places;  // xx, xy, yy
    vec3 light;
    vec3 light_x;
    vec3 light_y;
};

// The mean of the light at place 0, by a fit with a ridge on its slopes.
VX_FN vec3 fitted_light(SlopeFit fit) {
    const float scale = 1.0f / fit.weight;
    const vec2 mean = fit.place * scale;
    const vec3 light = fit.light * scale;
    const float xx = fit.places.x * scale - mean.x * mean.x + kSlopeRidge;
    const float xy = fit.places.y * scale - mean.x * mean.y;
    const float yy = fit.places.z * scale - mean.y * mean.y + kSlopeRidge;
    const vec3 with_x = fit.light_x * scale - light * mean.x;
    const vec3 with_y = fit.light_y * scale - light * mean.y;
    const float determinant = 1.0f / (xx * yy - xy * xy);
    const vec3 slope_x = (with_x * yy - with_y * xy) * determinant;
    const vec3 slope_y = (with_y * xx - with_x * xy) * determinant;
    return max(light - slope_x * mean.x - slope_y * mean.y, vec3(0.0f));
}

// The same for a fit of light over features: differences of mean normals and of offsets.
struct FeatureFit {
    float weight;
    vec4 feature;
    mat4 features;
    vec3 light;
    vec4 red;
    vec4 green;
    vec4 blue;
};

// Features of a tap; the offset's is bounded, because it counts no more once it says that planes differ.
VX_FN vec4 features_of(vec4 centre, vec4 tap) {
    vec4 difference = tap - centre;
    difference.w = difference.w / (1.0f + abs(difference.w));
    return difference;
}

// The mean of the light at feature 0.
VX_FN vec3 featured_light(FeatureFit fit) {
    const float scale = 1.0f / fit.weight;
    const vec4 mean = fit.feature * scale;
    const vec3 light = fit.light * scale;
    const mat4 spread = fit.features * scale - outerProduct(mean, mean) + mat4(kFeatureRidge);
    const vec4 away = inverse(spread) * mean;  // the spread is symmetric
    const vec3 slope =
        vec3(dot(fit.red * scale - mean * light.x, away), dot(fit.green * scale - mean * light.y, away),
             dot(fit.blue * scale - mean * light.z, away));
    return max(light - slope, vec3(0.0f));
}

// A pixel's terms of the best share of y in x + share (y - x): the first of the numerator, the second of the
// denominator. `raw` is the other half as it is, `scale` the square of how much light counts.
VX_FN vec2 share_terms(vec3 x, vec3 y, vec3 raw, vec3 scale) {
    const vec3 step = (x - y) * scale;
    return vec2(dot(x - raw, step), dot(x - y, step));
}

// The share by sums of terms. Where y is x, or nothing is known, it is 0.
VX_FN float share_of(vec2 terms) {
    return terms.y > 0.0f ? clamp(terms.x / terms.y, 0.0f, 1.0f) : 0.0f;
}

// An estimate without bias of the squared error of share F_A + (1 - share) F_B, where F_A is made of half A
// alone, which has this share of the samples, and F_B of half B. Variances of the halves are as 1 / samples;
// the mean of two errs by the mean of their squared errors less a quarter of their squared difference, and so
// for other shares. It may be negative.
VX_FN vec3 squared_error(vec3 filtered_a, vec3 filtered_b, vec3 a, vec3 b, float share) {
    const float rest = 1.0f - share;
    const vec3 apart = (a - b) * (a - b);
    const vec3 of_a = (filtered_a - b) * (filtered_a - b) - share * apart;
    const vec3 of_b = (filtered_b - a) * (filtered_b - a) - rest * apart;
    const vec3 between = (filtered_a - filtered_b) * (filtered_a - filtered_b);
    return share * of_a + rest * of_b - share * rest * between;
}

VX_END

#endif
