// Evaluates every expression of device_facts.h once.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/invocation.glsl"

#include "probe/device_facts.h"

layout(scalar) readonly buffer In { FactInputs inputs[]; };
layout(scalar) writeonly buffer Out { FactResults outputs[]; };
layout(push_constant, scalar) uniform Push { uint count; } push;

bool has_nan_bits(float x) { return (floatBitsToUint(x) & 0x7FFFFFFFu) > 0x7F800000u; }

uint guarded_uint(float x) {
    if (has_nan_bits(x)) return 0u;
    return uint(clamp(x, 0.0, 4294967040.0));  // the largest float below 2^32
}

void show_floats(FactInputs v, inout FactResults r) {
    r.min_nan_one = floatBitsToUint(min(v.nan, v.one));
    r.min_one_nan = floatBitsToUint(min(v.one, v.nan));
    r.max_nan_one = floatBitsToUint(max(v.nan, v.one));
    r.max_one_nan = floatBitsToUint(max(v.one, v.nan));
    r.clamp_nan = floatBitsToUint(clamp(v.nan, 0.0, 1.0));
    r.one_over_zero = floatBitsToUint(v.one / v.zero);
    r.one_over_neg_zero = floatBitsToUint(v.one / v.neg_zero);
    r.inf_minus_inf = floatBitsToUint(v.inf - v.inf);
    precise float difference = v.other_inf - v.other_inf;
    r.inf_minus_inf_precise = floatBitsToUint(difference);
    r.zero_times_inf = floatBitsToUint(v.zero * v.inf);
    r.zero_over_zero = floatBitsToUint(v.zero / v.zero);
    r.denormal_times_one = floatBitsToUint(v.denormal * v.one);
    r.denormal_times_half = floatBitsToUint(v.denormal * v.half_);
    r.fract_small_negative = floatBitsToUint(fract(v.small_negative));
    r.pow_zero_zero = floatBitsToUint(pow(v.zero, v.zero));
    r.normalize_zero = floatBitsToUint(normalize(vec3(v.zero)).x);
    r.normalize_tiny = floatBitsToUint(normalize(vec3(v.tiny)).x);
    r.normalize_huge = floatBitsToUint(normalize(vec3(v.huge)).x);
    r.length_large = floatBitsToUint(length(vec3(v.large)));
    r.sign_nan = floatBitsToUint(sign(v.nan));
    r.acos_above_one = floatBitsToUint(acos(v.above_one));
    r.sqrt_neg_one = floatBitsToUint(sqrt(v.neg_one));
    precise float above = v.above_one * v.above_one;
    r.fma_is_fused = fma(v.above_one, v.above_one, -above) != 0.0 ? 1u : 0u;
}

void show_integers(FactInputs v, inout FactResults r) {
    r.uint_of_nan = uint(v.nan);
    r.uint_of_neg_one = uint(v.neg_one);
    r.uint_of_large = uint(v.large);
    r.int_of_nan = uint(int(v.nan));
    r.seven_over_zero = v.seven / v.zero_word;
    r.seven_mod_zero = v.seven % v.zero_word;
    r.one_shifted_by_32 = 1u << v.thirty_two;
    r.read_past_the_end = floatBitsToUint(inputs[push.count + 1000u].one);
    r.nan_less_than_one = v.nan < v.one ? 1u : 0u;
    r.nan_at_least_one = v.nan >= v.one ? 1u : 0u;
    r.nan_equals_nan = v.nan == v.nan ? 1u : 0u;
}

void test_reliance(FactInputs v, inout FactResults r) {
    r.isnan_of_nan = isnan(v.nan) ? 1u : 0u;
    r.isnan_of_inf = isnan(v.inf) ? 1u : 0u;
    r.isnan_of_one = isnan(v.one) ? 1u : 0u;
    r.isinf_of_inf = isinf(v.inf) ? 1u : 0u;
    r.isinf_of_neg_inf = isinf(-v.inf) ? 1u : 0u;
    r.isinf_of_nan = isinf(v.nan) ? 1u : 0u;
    r.nan_bits_are_nan = has_nan_bits(v.nan) ? 1u : 0u;
    r.inf_bits = floatBitsToUint(v.inf);
    r.one_over_neg_zero_times_zero_bits_are_nan = has_nan_bits((v.one / v.neg_zero) * v.zero) ? 1u : 0u;
    r.inf_above_huge = v.inf > v.huge ? 1u : 0u;
    r.neg_inf_below_neg_one = -v.inf < v.neg_one ? 1u : 0u;
    r.min_inf_one = floatBitsToUint(min(v.inf, v.one));
    r.max_inf_one = floatBitsToUint(max(v.inf, v.one));
    r.guarded_uint_of_nan = guarded_uint(v.nan);
    r.guarded_uint_of_neg_one = guarded_uint(v.neg_one);
    r.guarded_uint_of_large = guarded_uint(v.large);
    precise float sum = v.one - v.small_negative;
    precise float rest = sum - v.one;
    r.precise_sum_error = floatBitsToUint(rest);
    r.masked_shift = 1u << (v.thirty_two & 31u);
}

void main() {
    uint i = linear_id();
    if (i >= push.count) return;
    FactResults r;
    show_floats(inputs[i], r);
    show_integers(inputs[i], r);
    test_reliance(inputs[i], r);
    outputs[i] = r;
}
