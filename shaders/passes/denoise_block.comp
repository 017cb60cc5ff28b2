#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Sums the terms of a block of pixels, separately for pixels that see one surface and for the others.

#include "lib/invocation.glsl"

#include "lib/denoise_planes.glsl"

VX_INPUT(Terms);
VX_INPUT(NormalA);
VX_INPUT(NormalB);
VX_OUTPUT(Sums);

void main() {
    uint across = (uint(push.size.x) + kDenoiseBlock - 1u) / kDenoiseBlock;
    uint down = (uint(push.size.y) + kDenoiseBlock - 1u) / kDenoiseBlock;
    uint block = linear_id();
    if (block >= across * down) return;
    ivec2 first = ivec2(kDenoiseBlock * uvec2(block % across, block / across));
    vec4 pure = vec4(0.0);
    vec4 mixed = vec4(0.0);
    for (uint i = 0u; i < kDenoiseBlock * kDenoiseBlock; ++i) {
        ivec2 place = first + ivec2(i % kDenoiseBlock, i / kDenoiseBlock);
        bool inside = is_inside(place);
        int at = inside ? texel_at(place) : 0;
        vec4 terms = inside ? VX_LOAD(Terms, at) : vec4(0.0);
        bool sees_one = is_pure(0.5 * (VX_LOAD(NormalA, at) + VX_LOAD(NormalB, at)));
        pure += sees_one ? terms : vec4(0.0);
        mixed += sees_one ? vec4(0.0) : terms;
    }
    VX_STORE(Sums, int(2u * block), pure);
    VX_STORE(Sums, int(2u * block + 1u), mixed);
}
