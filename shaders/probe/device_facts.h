// How the device evaluates expressions that the languages leave open: inputs and results, in words.
#ifndef VX_DEVICE_FACTS_H
#define VX_DEVICE_FACTS_H

#include "shared/portable.h"

VX_BEGIN

// Loaded at run time, so that no compiler folds them.
struct FactInputs {
    float nan;
    float inf;
    float other_inf;  // inf again: compilers give equal expressions one result, precise or not
    float zero;
    float neg_zero;
    float one;
    float half_;  // 0.5
    float neg_one;
    float denormal;        // 1e-40
    float small_negative;  // -1e-10
    float tiny;            // 1e-30
    float large;           // 1e20
    float huge;            // 1e30
    float above_one;       // next after 1
    uint zero_word;
    uint seven;
    uint thirty_two;
};

// Floats as their bits. The first results are for information only; shaders rely on the later ones.
struct FactResults {
    uint min_nan_one;
    uint min_one_nan;
    uint max_nan_one;
    uint max_one_nan;
    uint clamp_nan;
    uint one_over_zero;
    uint one_over_neg_zero;
    uint inf_minus_inf;
    uint inf_minus_inf_precise;
    uint zero_times_inf;
    uint zero_over_zero;
    uint denormal_times_one;
    uint denormal_times_half;
    uint fract_small_negative;
    uint pow_zero_zero;
    uint normalize_zero;
    uint normalize_tiny;
    uint normalize_huge;
    uint length_large;
    uint uint_of_nan;
    uint uint_of_neg_one;
    uint uint_of_large;
    uint int_of_nan;
    uint seven_over_zero;
    uint seven_mod_zero;
    uint one_shifted_by_32;
    uint sign_nan;
    uint acos_above_one;
    uint sqrt_neg_one;
    uint read_past_the_end;
    uint nan_less_than_one;
    uint nan_at_least_one;
    uint nan_equals_nan;
    uint fma_is_fused;

    uint isnan_of_nan;
    uint isnan_of_inf;
    uint isnan_of_one;
    uint isinf_of_inf;
    uint isinf_of_neg_inf;
    uint isinf_of_nan;
    uint nan_bits_are_nan;  // the bit test (bits & 0x7FFFFFFF) > 0x7F800000
    uint inf_bits;
    uint one_over_neg_zero_times_zero_bits_are_nan;
    uint inf_above_huge;
    uint neg_inf_below_neg_one;
    uint min_inf_one;
    uint max_inf_one;
    uint guarded_uint_of_nan;  // select by bits, clamp, convert
    uint guarded_uint_of_neg_one;
    uint guarded_uint_of_large;
    uint precise_sum_error;  // (1 + 1e-10) - 1, precise
    uint masked_shift;       // 1 << (32 & 31)
};

VX_END

#endif
