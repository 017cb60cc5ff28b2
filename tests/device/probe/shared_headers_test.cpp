// Runs each shared header on the device and compares with the same header compiled as C++.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "probe/probe_functions.h"
#include "support/probe.h"
#include "support/same_bits.h"
#include "support/sphere_cases.h"
#include "support/statistics.h"
#include "support/two_float_cases.h"

namespace voxilux {
namespace {

constexpr std::size_t kInvocations = 20000;
constexpr std::array<std::uint32_t, 9> kEdgeWords = {
    0u, 1u, 8191u, 8192u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFF00u, 0xFFFFFFFEu, 0xFFFFFFFFu};

// An edge word one time in three, else random.
std::uint32_t draw_word(test::TestRandom& random) {
    const std::uint32_t word = random.bits32();
    return word % 3 == 0 ? kEdgeWords[random.bits32() % kEdgeWords.size()] : word;
}

// Device and C++ on the same inputs, every bit of every output.
template <typename In, typename Out>
void expect_same_bits(const std::string& shader, const std::vector<In>& inputs, Out (*on_cpu)(In)) {
    const std::vector<Out> got = run_probe<In, Out>(shader, inputs);
    std::vector<Out> want;
    for (const In& input : inputs)
        want.push_back(on_cpu(input));
    const auto difference = test::differing_bits<Out>(got, want);
    EXPECT_EQ(difference.count, 0u) << shader << " differs first at " << difference.first << ", "
                                    << difference.detail;
}

std::vector<gpu::SampleIn> sample_inputs(std::uint32_t dimensions) {
    test::TestRandom random(20);
    std::vector<gpu::SampleIn> inputs(kInvocations);
    for (gpu::SampleIn& in : inputs)
        in = {draw_word(random), draw_word(random), draw_word(random), random.bits32() % dimensions};
    return inputs;
}

TEST(SharedHeaders, hash_is_bit_equal_on_the_device) {
    test::TestRandom random(21);
    std::vector<gpu::HashIn> inputs(kInvocations);
    for (gpu::HashIn& in : inputs)
        in.words = {draw_word(random), draw_word(random), draw_word(random), draw_word(random)};
    expect_same_bits("hash", inputs, gpu::probe_hash);
}

TEST(SharedHeaders, rng_is_bit_equal_on_the_device) {
    expect_same_bits("rng", sample_inputs(64), gpu::probe_rng);
}

TEST(SharedHeaders, halton_is_bit_equal_on_the_device) {
    expect_same_bits("halton", sample_inputs(16), gpu::probe_halton);
}

TEST(SharedHeaders, sobol_is_bit_equal_on_the_device) {
    expect_same_bits("sobol", sample_inputs(64), gpu::probe_sobol);
}

TEST(SharedHeaders, sequence_is_bit_equal_on_the_device) {
    expect_same_bits("sequence", sample_inputs(16), gpu::probe_sequence);
}

std::vector<gpu::FilmSumIn> film_inputs() {
    test::TestRandom random(22);
    std::vector<gpu::FilmSumIn> inputs(kInvocations);
    for (gpu::FilmSumIn& in : inputs) {
        in.value = gpu::uintBitsToFloat(random.bits32());
        if (random.bits32() % 2 == 0) in.value = static_cast<float>(std::exp(random.uniform(-25.0, 15.0)));
        in.a = {draw_word(random), draw_word(random)};
        in.b = {draw_word(random), draw_word(random)};
    }
    const float inf = std::numeric_limits<float>::infinity();
    const std::array<float, 10> edges = {
        0.0f, -0.0f, inf, -inf, std::nanf(""), gpu::kFilmMaxValue, 1e30f, 0x1p-25f, 0x1.8p-24f, 1e-42f};
    for (std::size_t i = 0; i < edges.size(); ++i)
        inputs[i].value = edges[i];
    return inputs;
}

TEST(SharedHeaders, film_sum_is_bit_equal_on_the_device) {
    expect_same_bits("film_sum", film_inputs(), gpu::probe_film_sum);
}

std::vector<gpu::SamplingIn> sampling_inputs() {
    test::TestRandom random(23);
    const float last = 1.0f - 0x1p-24f;
    const std::array<float, 6> edges = {0.0f, 0.25f, 0.5f, 0.75f, last, 0x1p-24f};
    const std::array<glm::vec3, 5> axes = {
        glm::vec3(0, 0, 1), {0, 0, -1}, {1, 0, 0}, {-0.0f, 1, 0}, {0, -1, -0.0f}};
    std::vector<gpu::SamplingIn> inputs(kInvocations);
    for (std::size_t i = 0; i < kInvocations; ++i) {
        gpu::SamplingIn& in = inputs[i];
        in.axis = i % 5 == 0 ? axes[i / 5 % axes.size()] : glm::vec3(test::random_unit(random));
        in.face = static_cast<std::uint32_t>(i % 6);
        in.u = {gpu::unit_float(random.bits32()), gpu::unit_float(random.bits32())};
        if (i % 7 == 0) in.u = {edges[i / 7 % 6], edges[i / 42 % 6]};
        in.cone_height = i % 3 == 0 ? 1.0695e-5f : static_cast<float>(random.uniform(0.0, 2.0));
    }
    return inputs;
}

// Only sqrt and division may round differently from device to device; llvmpipe rounds them as C++ does.
TEST(SharedHeaders, sampling_is_bit_equal_on_the_device) {
    expect_same_bits("sampling", sampling_inputs(), gpu::probe_sampling);
}

std::vector<gpu::TwoFloatIn> two_float_inputs() {
    std::vector<gpu::TwoFloatIn> inputs;
    for (const auto& [a, b] : test::two_float_cases(static_cast<int>(kInvocations)))
        inputs.push_back({a, b});
    return inputs;
}

TEST(SharedHeaders, two_float_keeps_its_relative_error_on_the_device) {
    const std::vector<gpu::TwoFloatIn> inputs = two_float_inputs();
    const auto outputs = run_probe<gpu::TwoFloatIn, gpu::TwoFloatOut>("two_float", inputs);
    using test::relative_error;
    using test::value_of;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const auto& [a, b] = inputs[i];
        const gpu::TwoFloatOut& out = outputs[i];
        ASSERT_EQ(value_of(out.sum_of_floats), static_cast<long double>(a.hi) + b.hi) << i;
        ASSERT_EQ(value_of(out.product_of_floats), static_cast<long double>(a.hi) * b.hi) << i;
        ASSERT_LE(relative_error(out.add, value_of(a) + value_of(b)), test::kTwoFloatError) << i;
        ASSERT_LE(relative_error(out.mul, value_of(a) * value_of(b)), test::kTwoFloatError) << i;
        ASSERT_LE(relative_error(out.mul_float, value_of(a) * b.hi), test::kTwoFloatError) << i;
        ASSERT_LE(relative_error(out.div, value_of(a) / value_of(b)), test::kTwoFloatError) << i;
    }
}

// The same sum without `precise`: llvmpipe re-associates it, and the error term is gone. Where a driver does
// not, the outputs agree and there is nothing to check.
TEST(SharedHeaders, two_float_sum_without_precise_is_caught_where_the_driver_reassociates) {
    const std::vector<gpu::TwoFloatIn> inputs = two_float_inputs();
    const auto outputs = run_probe<gpu::TwoFloatIn, gpu::TwoFloat>("plain_two_sum", inputs);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const long double exact = static_cast<long double>(inputs[i].a.hi) + inputs[i].b.hi;
        lost += test::value_of(outputs[i]) != exact ? 1 : 0;
    }
    RecordProperty("lost", static_cast<int>(lost));
    if (test_device().info().name.find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << lost << " sums lost bits";
    EXPECT_GT(lost, 0u);
}

TEST(SharedHeaders, sphere_hits_on_the_device_equal_long_double_within_rounding) {
    const std::vector<test::SphereCase> cases = test::sphere_cases(static_cast<int>(kInvocations));
    std::vector<gpu::SphereIn> inputs;
    for (const test::SphereCase& c : cases)
        inputs.push_back({c.sphere, c.origin, c.direction, c.t_min, c.t_max});
    const auto outputs = run_probe<gpu::SphereIn, gpu::SphereOut>("sphere", inputs);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const gpu::SphereHit hit{outputs[i].hit != 0, outputs[i].t, outputs[i].normal};
        ASSERT_LE(test::sphere_errors(cases[i], hit).worst(), 1.0) << i;
    }
}

TEST(SharedHeaders, hostile_spheres_on_the_device_never_give_nan) {
    const float inf = std::numeric_limits<float>::infinity();
    const std::array<float, 9> values = {0.0f, -0.0f, 1.0f, -1.0f, 1e-30f, 1e30f, inf, -inf, std::nanf("")};
    test::TestRandom random(24);
    const auto pick = [&] { return values[random.bits32() % values.size()]; };
    const auto pick_vector = [&] { return glm::vec3(pick(), pick(), pick()); };
    std::vector<gpu::SphereIn> inputs(kInvocations);
    for (gpu::SphereIn& in : inputs)
        in = {{pick_vector(), std::abs(pick()), pick_vector()}, pick_vector(), pick_vector(), 0.0f, 1e20f};
    for (const gpu::SphereOut& out : run_probe<gpu::SphereIn, gpu::SphereOut>("sphere", inputs)) {
        if (out.hit == 0) continue;
        ASSERT_TRUE(out.t >= 0.0f && out.t <= 1e20f);
        ASSERT_NEAR(glm::length(out.normal), 1.0f, 1e-5f);
    }
}

std::vector<gpu::BsdfIn> bsdf_inputs() {
    constexpr std::array<float, 5> kEtas = {0.0f, 1.5f, 1.0f / 1.5f, 2.5f, 0.4f};
    test::TestRandom random(25);
    std::vector<gpu::BsdfIn> inputs(kInvocations);
    for (gpu::BsdfIn& in : inputs) {
        in.normal = glm::vec3(test::random_unit(random));
        in.outward = glm::vec3(test::random_unit(random));
        if (glm::dot(in.outward, in.normal) < 0.0f) in.outward = -in.outward;
        in.u = {gpu::unit_float(random.bits32()), gpu::unit_float(random.bits32()),
                gpu::unit_float(random.bits32())};
        in.alpha = static_cast<float>(std::exp2(random.uniform(-4.0, 0.0)));
        in.eta = kEtas[random.bits32() % kEtas.size()];
    }
    return inputs;
}

// Products and roots are not precise, so a few bits differ. A direction along the surface may be masked by
// one of the two and not by the other, and Fresnel's choice may fall on either side.
TEST(SharedHeaders, rough_bsdf_on_the_device_is_that_of_cpp) {
    const std::vector<gpu::BsdfIn> inputs = bsdf_inputs();
    const auto outputs = run_probe<gpu::BsdfIn, gpu::BsdfOut>("bsdf", inputs);
    std::size_t apart = 0, lost = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const gpu::BsdfOut want = gpu::probe_bsdf(inputs[i]), &got = outputs[i];
        ASSERT_TRUE(std::isfinite(got.pdf) && std::isfinite(got.weight));
        lost += want.pdf > 0.0f ? 0 : 1;
        const bool is_near = glm::distance(got.inward, want.inward) < 1e-5f && got.crosses == want.crosses &&
                             std::abs(got.pdf - want.pdf) <= 1e-3f * want.pdf + 1e-6f &&
                             std::abs(got.weight - want.weight) <= 1e-4f &&
                             std::abs(got.place - want.place) <= 1e-5f;
        apart += is_near ? 0 : 1;
    }
    EXPECT_LT(apart, kInvocations / 500);
    EXPECT_GT(lost, kInvocations / 100);
    EXPECT_LT(lost, kInvocations / 4);
}

TEST(SharedHeaders, a_changed_input_is_caught_by_the_comparison) {
    std::vector<gpu::SampleIn> inputs = sample_inputs(16);
    const auto got = run_probe<gpu::SampleIn, gpu::SequenceOut>("sequence", inputs);
    inputs[777].stream ^= 1u;
    std::vector<gpu::SequenceOut> want;
    for (const gpu::SampleIn& in : inputs)
        want.push_back(gpu::probe_sequence(in));
    const auto difference = test::differing_bits<gpu::SequenceOut>(got, want);
    EXPECT_EQ(difference.count, 1u);
    EXPECT_EQ(difference.first, 777u);
}

}  // namespace
}  // namespace voxilux
