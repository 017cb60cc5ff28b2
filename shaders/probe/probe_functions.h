// What each probe computes from one input: the same function runs on the device and, compiled as C++, beside
// it. Probe shaders only fetch, call and store.
#ifndef VX_PROBE_FUNCTIONS_H
#define VX_PROBE_FUNCTIONS_H

#include "shared/alias.h"
#include "shared/bsdf.h"
#include "shared/dielectric.h"
#include "shared/film_sum.h"
#include "shared/sampling.h"
#include "shared/sequence.h"
#include "shared/sphere.h"
#include "shared/sppm.h"
#include "shared/two_float.h"

VX_BEGIN

struct HashIn {
    uvec4 words;
};
struct HashOut {
    uvec4 four;
    uvec3 three;
    uint one;
    uint mixed;
};
VX_FN HashOut probe_hash(HashIn v) {
    HashOut r;
    r.four = pcg4d(v.words);
    r.three = pcg3d(uvec3(v.words.x, v.words.y, v.words.z));
    r.one = pcg_hash(v.words.x);
    r.mixed = hash4(v.words.x, v.words.y, v.words.z, v.words.w);
    return r;
}

// Counters of one sample.
struct SampleIn {
    uint seed;
    uint stream;
    uint index;
    uint dimension;
};

struct RngOut {
    uint bits;
    float value;
};
VX_FN RngOut probe_rng(SampleIn v) {
    RngOut r;
    r.bits = rng_uint(v.seed, v.stream, v.index, v.dimension);
    r.value = rng_float(v.seed, v.stream, v.index, v.dimension);
    return r;
}

struct HaltonOut {
    uint inverse;
    float value;
};
VX_FN HaltonOut probe_halton(SampleIn v) {
    HaltonOut r;
    r.inverse = radical_inverse_24(v.index % (kHaltonPeriod + 1u), halton_base(v.dimension));
    r.value = halton_float(v.seed, v.stream, v.index, v.dimension);
    return r;
}

struct SobolOut {
    uvec2 point;
    uint second;
    uint scrambled;
};
VX_FN SobolOut probe_sobol(SampleIn v) {
    SobolOut r;
    r.point = sobol_pair(v.seed, v.stream, v.index, v.dimension);
    r.second = sobol_second(v.index);
    r.scrambled = owen_scramble(v.index, v.seed);
    return r;
}

struct SequenceOut {
    vec2 sobol;
    vec2 halton;
    vec2 white;
    vec3 single;  // one-dimensional sobol, halton, white
    SampleKey wide;
};
VX_FN SequenceOut probe_sequence(SampleIn v) {
    SampleKey key = sample_key(v.stream, uvec2(v.index, 0u), v.seed);
    SequenceOut r;
    r.sobol = sample_2d(kSequenceSobol, key, v.dimension);
    r.halton = sample_2d(kSequenceHalton, key, v.dimension);
    r.white = sample_2d(kSequenceWhite, key, v.dimension);
    r.single = vec3(sample_1d(kSequenceSobol, key, v.dimension), sample_1d(kSequenceHalton, key, v.dimension),
                    sample_1d(kSequenceWhite, key, v.dimension));
    r.wide = sample_key(v.stream, uvec2(v.index, v.dimension), v.seed);
    return r;
}

struct SamplingIn {
    vec3 axis;  // unit
    uint face;
    vec2 u;
    float cone_height;
};
struct SamplingOut {
    vec2 sin_cos;
    vec3 disk;
    vec3 face_normal;
    vec3 on_face;
    vec3 tangent;
    vec3 bitangent;
    vec3 about_axis;
    vec3 in_cone;
};
VX_FN SamplingOut probe_sampling(SamplingIn v) {
    SamplingOut r;
    r.sin_cos = sin_cos_eighth(2.0f * v.u.x - 1.0f);
    r.disk = concentric_disk(v.u);
    r.face_normal = face_normal(v.face);
    r.on_face = cosine_on_face(v.face, v.u);
    Basis basis = basis_around(v.axis);
    r.tangent = basis.tangent;
    r.bitangent = basis.bitangent;
    r.about_axis = cosine_about(v.axis, v.u);
    r.in_cone = uniform_cone(v.axis, v.cone_height, v.u);
    return r;
}

struct FilmSumIn {
    float value;
    uvec2 a;
    uvec2 b;
};
struct FilmSumOut {
    FilmFixed converted;
    uvec2 sum;
    uvec2 negated;
    uvec2 square;
    uvec2 square_sum;
    uint overflows;
};
VX_FN FilmSumOut probe_film_sum(FilmSumIn v) {
    FilmSumOut r;
    r.converted = film_fixed(v.value);
    r.sum = film_add(v.a, v.b);
    r.negated = film_negate(v.a);
    r.square = film_square(v.value);
    r.square_sum = film_add_square(v.a, v.b);
    r.overflows = film_add_overflows(v.a, v.b) ? 1u : 0u;
    return r;
}

struct TwoFloatIn {
    TwoFloat a;
    TwoFloat b;
};
struct TwoFloatOut {
    TwoFloat sum_of_floats;
    TwoFloat product_of_floats;
    TwoFloat add;
    TwoFloat mul;
    TwoFloat mul_float;
    TwoFloat div;
};
VX_FN TwoFloatOut probe_two_float(TwoFloatIn v) {
    TwoFloatOut r;
    r.sum_of_floats = two_sum(v.a.hi, v.b.hi);
    r.product_of_floats = two_prod(v.a.hi, v.b.hi);
    r.add = tf_add(v.a, v.b);
    r.mul = tf_mul(v.a, v.b);
    r.mul_float = tf_mul_float(v.a, v.b.hi);
    r.div = tf_div(v.a, v.b);
    return r;
}

// two_sum without precise, as the driver optimizes it. It has a shader of its own, because the compiler would
// merge it with an equal precise expression.
VX_FN TwoFloat probe_plain_two_sum(TwoFloatIn v) {
    float s = v.a.hi + v.b.hi;
    float b_part = s - v.a.hi;
    return two_float(s, (v.a.hi - (s - b_part)) + (v.b.hi - b_part));
}

struct SphereIn {
    Sphere sphere;
    vec3 origin;
    vec3 direction;
    float t_min;
    float t_max;
};
struct SphereOut {
    uint hit;
    float t;
    vec3 normal;
};
VX_FN SphereOut probe_sphere(SphereIn v) {
    SphereHit hit = sphere_intersect(v.sphere, v.origin, v.direction, v.t_min, v.t_max);
    SphereOut r;
    r.hit = hit.hit ? 1u : 0u;
    r.t = hit.t;
    r.normal = hit.normal;
    return r;
}

struct BsdfIn {
    vec3 outward;  // unit, on the side of the normal
    vec3 normal;   // unit
    vec3 u;
    float alpha;
    float eta;
};
struct BsdfOut {
    vec3 inward;
    float pdf;
    float weight;
    float place;  // on a row of gains
    uint crosses;
};
VX_FN BsdfOut probe_bsdf(BsdfIn v) {
    BsdfOut r;
    r.inward = sample_rough(v.outward, v.normal, v.alpha, v.eta, v.u);
    RoughValue value = evaluate_rough(v.outward, r.inward, v.normal, v.alpha, v.eta);
    r.pdf = value.pdf;
    r.weight = value.weight;
    r.place = gain_place(dot(v.outward, v.normal), v.alpha);
    r.crosses = value.crosses ? 1u : 0u;
    return r;
}

struct DielectricIn {
    float cosine;
    float eta;
    vec3 direction;
    vec3 normal;
};
struct DielectricOut {
    float reflectance;  // for the cosine
    float bend;
    uint is_total;
    uint ray_is_total;  // for the direction
    vec3 refracted;
    vec3 mirrored;
};
VX_FN DielectricOut probe_dielectric(DielectricIn v) {
    DielectricOut r;
    Dielectric surface = dielectric(v.cosine, v.eta);
    r.reflectance = surface.reflectance;
    r.bend = surface.bend;
    r.is_total = surface.is_total ? 1u : 0u;
    VX_PRECISE float cosine = -dot(v.direction, v.normal);
    Dielectric met = dielectric(cosine, v.eta);
    r.ray_is_total = met.is_total ? 1u : 0u;
    r.refracted = refracted_direction(v.direction, v.normal, v.eta, met);
    r.mirrored = mirror_direction(v.direction, v.normal);
    return r;
}

struct SppmIn {
    vec2 u_place;
    vec2 u_direction;
    vec3 to_centre;
    float radius;
    vec3 throughput;
    float distance_squared;
    uint bits;
    uint count;
};
struct SppmOut {
    SphereEmission emission;
    SphereCone cone;
    float kernel;
    float survival;
    uint bucket;
};
VX_FN SppmOut probe_sppm(SppmIn v) {
    SppmOut r;
    r.emission = sphere_emission(v.u_place, v.u_direction);
    r.cone = sphere_cone(v.to_centre, v.radius);
    r.kernel = photon_kernel(v.distance_squared, v.radius);
    r.survival = roulette_survival(v.throughput);
    r.bucket = alias_bucket(v.bits, v.count);
    return r;
}

VX_END

#endif
