// The headers of photon mapping on the device, against closed forms and against themselves as C++.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "probe/probe_functions.h"
#include "support/dielectric_cases.h"
#include "support/probe.h"
#include "support/same_bits.h"

namespace voxilux {
namespace {

constexpr int kCount = 20000;

std::vector<gpu::DielectricIn> dielectric_inputs() {
    std::vector<gpu::DielectricIn> inputs;
    for (const test::DielectricCase& c : test::dielectric_cases(kCount))
        inputs.push_back({c.cosine, c.eta, c.direction, c.normal});
    return inputs;
}

TEST(PhotonHeaders, fresnel_on_the_device_is_exact_within_2_ulp_and_decides_total_reflection_exactly) {
    const std::vector<gpu::DielectricIn> inputs = dielectric_inputs();
    const auto outputs = run_probe<gpu::DielectricIn, gpu::DielectricOut>("dielectric", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const long double transmitted = test::exact_transmittance(inputs[i].cosine, inputs[i].eta);
        ASSERT_NEAR(static_cast<double>(outputs[i].reflectance + transmitted), 1.0, 0x1p-22) << i;
        ASSERT_EQ(outputs[i].is_total != 0, transmitted <= 0.0L) << i;
    }
}

TEST(PhotonHeaders, directions_at_glass_on_the_device_obey_snell) {
    const std::vector<gpu::DielectricIn> inputs = dielectric_inputs();
    const auto outputs = run_probe<gpu::DielectricIn, gpu::DielectricOut>("dielectric", inputs);
    constexpr double kTolerance = 16.0 * 0x1p-24;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec3 normal(inputs[i].normal);
        const glm::dvec3 before = glm::cross(glm::dvec3(inputs[i].direction), normal);
        const glm::dvec3 mirrored = glm::cross(glm::dvec3(outputs[i].mirrored), normal);
        ASSERT_LT(glm::length(before - mirrored), kTolerance) << i;
        if (outputs[i].ray_is_total != 0) continue;
        const auto eta = static_cast<double>(inputs[i].eta);
        const glm::dvec3 after = glm::cross(glm::dvec3(outputs[i].refracted), normal) * eta;
        ASSERT_LT(glm::length(before - after), kTolerance * std::max(1.0, eta)) << i;
        ASSERT_NEAR(glm::length(glm::dvec3(outputs[i].refracted)), 1.0, kTolerance) << i;
    }
}

TEST(PhotonHeaders, hostile_numbers_at_glass_on_the_device_never_give_nan) {
    std::vector<gpu::DielectricIn> inputs;
    for (const float cosine : test::hostile_floats()) {
        for (const float eta : test::hostile_floats())
            inputs.push_back({cosine, eta, glm::vec3(0, 0, -1), glm::vec3(0, 0, 1)});
    }
    for (const auto& out : run_probe<gpu::DielectricIn, gpu::DielectricOut>("dielectric", inputs)) {
        ASSERT_GE(out.reflectance, 0.0f);
        ASSERT_LE(out.reflectance, 1.0f);
        ASSERT_FALSE(std::isnan(out.bend));
    }
}

std::vector<gpu::SppmIn> sppm_inputs() {
    test::TestRandom random(41);
    const auto unit = [&] { return static_cast<float>(random.bits32() >> 8) * 0x1p-24f; };
    std::vector<gpu::SppmIn> inputs(kCount);
    for (gpu::SppmIn& in : inputs) {
        in.u_place = {unit(), unit()};
        in.u_direction = {unit(), unit()};
        in.to_centre = test::random_float_unit(random) * static_cast<float>(random.uniform(0.5, 500.0));
        in.radius = static_cast<float>(std::exp(random.uniform(-6.0, 6.0)));
        in.throughput =
            glm::vec3(unit(), unit(), unit()) * static_cast<float>(std::exp(random.uniform(-40.0, 2.0)));
        in.distance_squared = in.radius * in.radius * static_cast<float>(random.uniform(0.5, 1.5));
        in.bits = random.bits32();
        in.count = random.bits32() >> (random.bits32() % 32);
    }
    return inputs;
}

TEST(PhotonHeaders, emission_cones_kernel_roulette_and_buckets_are_bit_equal_on_the_device) {
    const std::vector<gpu::SppmIn> inputs = sppm_inputs();
    const auto got = run_probe<gpu::SppmIn, gpu::SppmOut>("sppm", inputs);
    std::vector<gpu::SppmOut> want;
    for (const gpu::SppmIn& in : inputs)
        want.push_back(gpu::probe_sppm(in));
    const auto difference = test::differing_bits<gpu::SppmOut>(got, want);
    EXPECT_EQ(difference.count, 0u) << difference.first << ", " << difference.detail;
}

}  // namespace
}  // namespace voxilux
