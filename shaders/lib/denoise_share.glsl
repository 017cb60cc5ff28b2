// The best mixture at a pixel, by the terms of the blocks around it. Include lib/denoise_planes.glsl first.
#ifndef VX_DENOISE_SHARE_GLSL
#define VX_DENOISE_SHARE_GLSL

VX_INPUT(Terms);
VX_INPUT(Sums);
VX_INPUT(NormalA);
VX_INPUT(NormalB);

// Sums of the terms around a pixel, interpolated bilinearly between blocks, over pixels of its own kind. The
// pixel's own terms are left out: a weight that follows the noise of the pixel would hide it from the error
// estimate (cross-validation).
vec4 terms_around(ivec2 place) {
    int at = texel_at(place);
    int kind = is_pure(0.5 * (VX_LOAD(NormalA, at) + VX_LOAD(NormalB, at))) ? 0 : 1;
    int block = int(kDenoiseBlock);
    ivec2 blocks = (push.size + block - 1) / block;
    ivec2 low = (place + block / 2) / block - 1;
    vec2 high_share = (vec2(place - block * low) + 0.5) / float(block) - 0.5;
    vec4 terms = vec4(0.0);
    float own = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        ivec2 other = low + side;
        bool inside = other.x >= 0 && other.y >= 0 && other.x < blocks.x && other.y < blocks.y;
        vec2 shares = mix(1.0 - high_share, high_share, vec2(side));
        float weight = inside ? shares.x * shares.y : 0.0;
        own += other == place / block ? weight : 0.0;
        terms += weight * VX_LOAD(Sums, inside ? 2 * (other.y * blocks.x + other.x) + kind : 0);
    }
    return terms - own * VX_LOAD(Terms, at);
}

#endif
