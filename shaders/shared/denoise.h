// The mathematics of the denoiser. The noisy part of an image's light is divided by the albedo and averaged
// over pixels of the same plane, in an a-trous scheme (Dammertz et al. 2010, "Edge-Avoiding A-Trous Wavelet
// Transform for fast Global Illumination Filtering"), with a linear fit in place of the mean from the second
// level on. Pixels that see several surfaces are found by first-order regression in features instead
// (Bitterli et al. 2016, "Nonlinearly Weighted First-Order Regression for Denoising Monte Carlo Renderings").
//
// Everything is done twice, for each half of the film by itself. The halves A and B are independent and
// unbiased, so each half shows the error of the other one's filtered image. For x and y made from one half,
// E[(x_A - B)(x_A - y_A)] = E[(x_A - I)(x_A - y_A)], I the true value. From this follow, without a model, the
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
VX_CONST(float, kPureNormal, 0.97f);  // length of a mean normal from which on a pixel counts as one plane
VX_CONST(float, kGuideScale, 10.0f);  // 1 / 0.1: squares of differences of normals, and of offsets in voxels
VX_CONST(float, kSlopeRidge, 0.03f);  // of slopes, in squares of a tap's reach
VX_CONST(float, kFeatureRidge, 0.01f);    // of features, whose differences are of the order of 1
VX_CONST(float, kMixedWeight, 0.1f);      // of a pixel that sees several surfaces, when others are available
VX_CONST(float, kLeastAlbedo, 0.02f);     // floor of a channel, relative to the luminance of the albedo
VX_CONST(float, kBlackAlbedo, 1e-6f);     // luminance below which a pixel counts as reflecting nothing
VX_CONST(float, kDenoiseEpsilon, 0.01f);  // that of relMSE
VX_CONST(float, kLeastWeight, 1e-30f);    // of a fit, so that its inverse is finite

// Push constants of all passes of the denoiser.
struct DenoisePush {
    ivec2 size;   // pixels
    int step;     // between taps, pixels
    float share;  // fraction of the samples in half A
};

// Light received by a surface, over pi, from what it reflects; and its weight, the squared albedo, because
// dividing by the albedo multiplies the variance by the inverse of that.
VX_FN vec4 received_light(vec3 reflected, vec3 albedo) {
    const float brightness = luminance_of(albedo);
    if (brightness < kBlackAlbedo) return vec4(0.0f, 0.0f, 0.0f, 0.0f);
    const vec3 divisor = max(albedo, vec3(kLeastAlbedo * brightness));
    return vec4(reflected / divisor, brightness * brightness);
}

// Unit normal and offset of a pixel that may be partly covered: both are means over the samples, misses
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

// Weight of a tap by its guide: approximately exp(-d), and 0 from d = 4 on.
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

// Weighted sums for the mean and a linear fit of light over positions in the image.
struct SlopeFit {
    float weight;
    vec2 place;
    vec3 places;  // xx, xy, yy
    vec3 light;
    vec3 light_x;
    vec3 light_y;
};

// The fitted light at position 0, with a ridge on the slopes.
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

// Features of a tap. The offset's is bounded, because beyond that it only says that the planes differ.
VX_FN vec4 features_of(vec4 centre, vec4 tap) {
    vec4 difference = tap - centre;
    difference.w = difference.w / (1.0f + abs(difference.w));
    return difference;
}

// The fitted light at feature 0.
VX_FN vec3 featured_light(FeatureFit fit) {
    const float scale = 1.0f / fit.weight;
    const vec4 mean = fit.feature * scale;
    const vec3 light = fit.light * scale;
    const mat4 spread = fit.features * scale - outerProduct(mean, mean) + mat4(kFeatureRidge);
    const vec4 away = inverse(spread) * mean;  // the matrix is symmetric
    const vec3 slope =
        vec3(dot(fit.red * scale - mean * light.x, away), dot(fit.green * scale - mean * light.y, away),
             dot(fit.blue * scale - mean * light.z, away));
    return max(light - slope, vec3(0.0f));
}

// A pixel's terms of the best weight w in x + w (y - x): of the numerator and of the denominator. `raw` is
// the unfiltered other half, `scale` the squared weight of light.
VX_FN vec2 share_terms(vec3 x, vec3 y, vec3 raw, vec3 scale) {
    const vec3 step = (x - y) * scale;
    return vec2(dot(x - raw, step), dot(x - y, step));
}

// The weight from sums of terms. Where y equals x, or nothing is known, it is 0.
VX_FN float share_of(vec2 terms) {
    return terms.y > 0.0f ? clamp(terms.x / terms.y, 0.0f, 1.0f) : 0.0f;
}

// An unbiased estimate of the squared error of share F_A + (1 - share) F_B, where F_A is made from half A
// alone, which has `share` of the samples, and F_B from half B. Variances of the halves are proportional to 1
// / samples. The squared error of the mean of two is the mean of their squared errors minus a quarter of
// their squared difference, and correspondingly for other shares. The estimate may be negative.
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
