// The passes that turn stored photons into light, against sums over all photons in double precision.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shared/photon_cell.h"
#include "shared/photon_power.h"
#include "support/photon_rig.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

using test::PhotonJob;
using test::PhotonOutcome;
using test::TestRandom;

glm::vec3 random_vec(TestRandom& random, double low, double high) {
    const auto one = [&] { return static_cast<float>(random.uniform(low, high)); };
    const float x = one(), y = one();
    return {x, y, one()};
}

gpu::Hit sphere_point(glm::vec3 position, std::uint32_t sphere) {
    const glm::vec3 corner = glm::floor(position);
    return {.cell = glm::ivec3(corner),
            .face = gpu::kFaceSphere,
            .fraction = position - corner,
            .sphere = sphere};
}

// Photons and points in a box about a centre, on as many spheres: what counts is the surface's number.
PhotonJob random_job(std::uint64_t seed, glm::vec3 centre, double spread, std::uint32_t surfaces) {
    TestRandom random(seed);
    PhotonJob job;
    job.setup = {.radius = 0.2 * spread,
                 .extent = 1.0 + spread + glm::length(glm::dvec3(centre)),
                 .most_power = {3.0, 2.0, 0.5},
                 .buckets = 1024,
                 .capacity = 4000,
                 .photon_count = 1000};
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 position = centre + random_vec(random, -spread, spread);
        const glm::vec3 power = random_vec(random, 0.0, 0.5);
        job.photons.push_back({position, gpu::kSphereSurface | random.bits32() % surfaces, power,
                               random.bits32() % 8 != 0 ? 1u : 0u});
    }
    for (int i = 0; i < 256; ++i)
        job.points.push_back(
            sphere_point(centre + random_vec(random, -spread, spread), random.bits32() % surfaces));
    return job;
}

// What the gather has to find at a point: exact sums of quanta over all photons. `is_close` when a photon is
// so near to the rim that a float may decide either way.
struct Truth {
    glm::dvec3 light{0.0};
    bool is_close = false;
};

Truth light_at(const PhotonJob& job, const gpu::Hit& hit, double radius) {
    const gpu::PhotonParams params = photon_params(job.setup);
    Truth truth;
    for (const gpu::PhotonIn& photon : job.photons) {
        if (photon.is_stored == 0 || photon.surface != gpu::photon_surface(hit)) continue;
        const glm::dvec3 point = glm::dvec3(gpu::photon_position(hit));
        const double distance = glm::length(glm::dvec3(photon.position) - point);
        truth.is_close = truth.is_close || std::abs(distance / radius - 1.0) < 1e-6;
        if (distance > radius) continue;
        const gpu::PackedPower packed = gpu::pack_power(photon.power, params.power_scale, photon.position);
        truth.light += glm::dvec3(gpu::unpack_power(packed.words)) * job.setup.most_power /
                       static_cast<double>(gpu::kPhotonQuanta);
    }
    truth.light /= std::numbers::pi * radius * radius;
    return truth;
}

// Points whose light differs from the truth by more than the roundings of a float; those with a photon on the
// rim are left out.
int wrong_points(const PhotonJob& job, const PhotonOutcome& outcome) {
    const gpu::PhotonParams params = photon_params(job.setup);
    int wrong = 0;
    for (std::size_t i = 0; i < job.points.size(); ++i) {
        const Truth wide = light_at(job, job.points[i], params.radius);
        const Truth narrow = light_at(job, job.points[i], params.narrow_radius);
        const auto differs = [](const Truth& truth, glm::vec3 got) {
            return !truth.is_close &&
                   glm::length(truth.light - glm::dvec3(got)) > 1e-6 * glm::length(truth.light);
        };
        wrong += differs(wide, outcome.light[i]) || differs(narrow, outcome.narrow[i]) ? 1 : 0;
    }
    return wrong;
}

void expect_no_faults(const PhotonOutcome& outcome) {
    for (std::size_t i = 0; i < gpu::kFaultCount; ++i)
        EXPECT_EQ(outcome.tally[i], 0u) << gpu::kTallyNames[i];
}

TEST(PhotonGather, light_is_the_sum_over_all_photons_of_the_surface_within_the_radius) {
    const glm::vec3 centres[] = {{0, 0, 0}, {-300, 40, 17}, {5, -3, -1e4f}};
    for (const glm::vec3 centre : centres) {
        for (const double spread : {0.5, 10.0}) {
            const PhotonJob job = random_job(7, centre, spread, 3);
            const PhotonOutcome outcome = test::run_photons(job);
            EXPECT_EQ(wrong_points(job, outcome), 0) << centre.z << ", " << spread;
            expect_no_faults(outcome);
        }
    }
}

TEST(PhotonGather, a_moved_photon_is_found) {
    PhotonJob job = random_job(7, {0, 0, 0}, 10.0, 3);
    const PhotonOutcome outcome = test::run_photons(job);
    for (gpu::PhotonIn& photon : job.photons)
        photon.position.x += 0.01f;
    EXPECT_GT(wrong_points(job, outcome), 10);
}

}  // namespace
}  // namespace voxilux
