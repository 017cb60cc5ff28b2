// Numbers of about 48 bits as the unevaluated sum of two floats, for places where 24 bits are too few and
// doubles are not portable. No fma: devices need not fuse it. Every step is precise, because the error terms
// are zero in real arithmetic, and a driver that re-associates would remove them.
//
// Domain: operands of magnitude 2^-100 to 2^100 or zero; products, quotients and numerators of 2^-70 to 2^100
// or zero. In it no split overflows and no error term underflows.
//
// Sources: Dekker 1971, "A Floating-Point Technique for Extending the Available Precision"; Joldes, Muller
// and Popescu 2017, "Tight and Rigorous Error Bounds for Basic Building Blocks of Double-Word Arithmetic",
// whose algorithm numbers are given below.
#ifndef VX_TWO_FLOAT_H
#define VX_TWO_FLOAT_H

#include "portable.h"

VX_BEGIN

// hi + lo, with |lo| at most half an ulp of hi.
struct TwoFloat {
    float hi;
    float lo;
};

VX_FN TwoFloat two_float(float hi, float lo) {
    TwoFloat r;
    r.hi = hi;
    r.lo = lo;
    return r;
}

// a + b exactly, given |a| >= |b| or a = 0. Algorithm 1, Fast2Sum.
VX_FN TwoFloat quick_two_sum(float a, float b) {
    VX_PRECISE float s = a + b;
    VX_PRECISE float z = s - a;
    VX_PRECISE float e = b - z;
    return two_float(s, e);
}

// a + b exactly. Algorithm 2, 2Sum (Knuth, "The Art of Computer Programming" 2, section 4.2.2, theorem B).
VX_FN TwoFloat two_sum(float a, float b) {
    VX_PRECISE float s = a + b;
    VX_PRECISE float a_part = s - b;
    VX_PRECISE float b_part = s - a_part;
    VX_PRECISE float a_error = a - a_part;
    VX_PRECISE float b_error = b - b_part;
    VX_PRECISE float e = a_error + b_error;
    return two_float(s, e);
}

// a as two halves of 12 bits whose products are exact: Veltkamp's split with 2^12 + 1.
VX_FN TwoFloat split(float a) {
    VX_PRECISE float c = 4097.0f * a;
    VX_PRECISE float d = a - c;
    VX_PRECISE float hi = c + d;
    VX_PRECISE float lo = a - hi;
    return two_float(hi, lo);
}

// a * b exactly. Dekker's product.
VX_FN TwoFloat two_prod(float a, float b) {
    TwoFloat x = split(a);
    TwoFloat y = split(b);
    VX_PRECISE float p = a * b;
    VX_PRECISE float e0 = x.hi * y.hi - p;
    VX_PRECISE float e1 = e0 + x.hi * y.lo;
    VX_PRECISE float e2 = e1 + x.lo * y.hi;
    VX_PRECISE float e = e2 + x.lo * y.lo;
    return two_float(p, e);
}

// a + b, relative error at most 3 * 2^-48. Algorithm 6, AccurateDWPlusDW.
VX_FN TwoFloat tf_add(TwoFloat a, TwoFloat b) {
    TwoFloat s = two_sum(a.hi, b.hi);
    TwoFloat t = two_sum(a.lo, b.lo);
    VX_PRECISE float c = s.lo + t.hi;
    TwoFloat v = quick_two_sum(s.hi, c);
    VX_PRECISE float w = t.lo + v.lo;
    return quick_two_sum(v.hi, w);
}

// a * b, relative error at most 7 * 2^-48. Algorithm 10, DWTimesDW1.
VX_FN TwoFloat tf_mul(TwoFloat a, TwoFloat b) {
    TwoFloat c = two_prod(a.hi, b.hi);
    VX_PRECISE float t1 = a.hi * b.lo;
    VX_PRECISE float t2 = a.lo * b.hi;
    VX_PRECISE float t = t1 + t2;
    VX_PRECISE float e = c.lo + t;
    return quick_two_sum(c.hi, e);
}

// a * b with a plain float b, relative error at most 3 * 2^-48. Algorithm 8, DWTimesFP2.
VX_FN TwoFloat tf_mul_float(TwoFloat a, float b) {
    TwoFloat c = two_prod(a.hi, b);
    VX_PRECISE float t = a.lo * b;
    VX_PRECISE float e = c.lo + t;
    return quick_two_sum(c.hi, e);
}

// a / b for b not 0, relative error at most 15 * 2^-48 where division is correctly rounded. Algorithm 17,
// DWDivDW2.
VX_FN TwoFloat tf_div(TwoFloat a, TwoFloat b) {
    VX_PRECISE float q = a.hi / b.hi;
    TwoFloat r = tf_mul_float(b, q);
    VX_PRECISE float d_hi = a.hi - r.hi;
    VX_PRECISE float d_lo = a.lo - r.lo;
    VX_PRECISE float d = d_hi + d_lo;
    VX_PRECISE float e = d / b.hi;
    return quick_two_sum(q, e);
}

VX_END

#endif
