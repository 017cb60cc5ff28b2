// The passes that turn stored photons into light, against sums over all photons in double precision.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include <gtest/gtest.h>

#include "shared/photon_cell.h"
#include "shared/photon_power.h"
#include "support/photon_fixture.h"
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
                 .max_power = {3.0, 2.0, 0.5},
                 .buckets = 1024,
                 .capacity = 4000};
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
// so near to the rim that rounding may decide either way.
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
        truth.light += glm::dvec3(gpu::unpack_power(packed.words)) * job.setup.max_power /
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
        const Truth half_area = light_at(job, job.points[i], params.half_area_radius);
        const auto differs = [](const Truth& truth, glm::vec3 got) {
            return !truth.is_close &&
                   glm::length(truth.light - glm::dvec3(got)) > 1e-6 * glm::length(truth.light);
        };
        wrong += differs(wide, outcome.light[i]) || differs(half_area, outcome.half_area[i]) ? 1 : 0;
    }
    return wrong;
}

void expect_no_faults(const PhotonOutcome& outcome) {
    for (std::size_t i = 0; i < gpu::kFaultCount; ++i)
        EXPECT_EQ(outcome.counters[i], 0u) << gpu::kCounterNames[i];
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

bool same_light(const PhotonOutcome& a, const PhotonOutcome& b) {
    const auto same = [](const std::vector<glm::vec3>& x, const std::vector<glm::vec3>& y) {
        return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(glm::vec3)) == 0;
    };
    return same(a.light, b.light) && same(a.half_area, b.half_area);
}

TEST(PhotonSplat, light_equals_the_gather_to_the_bit) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        PhotonJob job = random_job(seed, {-3, 200, seed == 3 ? -1e4f : 0.0f}, 6.0, 2);
        const PhotonOutcome gathered = test::run_photons(job);
        EXPECT_TRUE(same_light(gathered, test::run_splat(job))) << seed;
        for (std::size_t i = 0; i < 50; ++i)
            job.photons[i].is_stored ^= 1u;
        EXPECT_FALSE(same_light(gathered, test::run_splat(job))) << seed;
    }
}

TEST(PhotonGather, tables_of_any_size_give_the_same_bits) {
    PhotonJob job = random_job(4, {0, 0, 0}, 10.0, 3);
    job.photons.resize(1500);
    const PhotonOutcome want = test::run_photons(job);
    EXPECT_EQ(wrong_points(job, want), 0);
    for (const std::uint32_t buckets : {1u, 2u, 4u, 16u, 64u, 1u << 16}) {
        job.setup.buckets = buckets;
        const PhotonOutcome gathered = test::run_photons(job);
        expect_no_faults(gathered);
        EXPECT_TRUE(same_light(want, gathered)) << buckets;
        EXPECT_TRUE(same_light(want, test::run_splat(job))) << buckets;
    }
}

// What a device cuts off is never silent: lavapipe ends loops after 65535 turns.
TEST(PhotonGather, sums_are_whole_or_a_fault_is_counted) {
    PhotonJob job = random_job(4, {0, 0, 0}, 10.0, 1);
    job.setup.radius = 100.0;
    job.setup.capacity = 100000;
    job.photons.resize(50);
    job.points.resize(16);
    const std::vector<gpu::PhotonIn> few = job.photons;
    while (job.photons.size() < 90000)
        job.photons.insert(job.photons.end(), few.begin(), few.end());
    const PhotonOutcome outcome = test::run_photons(job);
    const bool is_whole = wrong_points(job, outcome) == 0;
    EXPECT_NE(is_whole, outcome.counters[gpu::kFaultLoopCut] > 0);
    job.photons.resize(30000);
    expect_no_faults(test::run_photons(job));
}

TEST(PhotonGather, a_full_store_loses_what_came_too_late_and_counts_it) {
    PhotonJob job = random_job(9, {0, 0, 0}, 5.0, 2);
    job.setup.radius = 20.0;  // so that points accept all photons
    for (gpu::PhotonIn& photon : job.photons)
        photon.is_stored = 1;
    const auto count = static_cast<std::uint32_t>(job.photons.size());
    for (const std::uint32_t capacity : {count, count - 1, 64u, 1u}) {
        job.setup.capacity = capacity;
        const PhotonOutcome outcome = test::run_photons(job);
        EXPECT_EQ(outcome.counters[gpu::kFaultPhotonStoreFull], count - capacity);
        EXPECT_EQ(outcome.counters[gpu::kWorkPhotonsStored], capacity);
        EXPECT_EQ(outcome.head.count, count);
        std::vector<std::array<std::uint64_t, gpu::kSortedWords>> sorted;
        for (std::size_t i = 0; i < capacity; ++i)
            sorted.push_back(std::bit_cast<std::array<std::uint64_t, gpu::kSortedWords>>(outcome.sorted[i]));
        std::ranges::sort(sorted);
        // Every sorted record is a photon of the job, none twice.
        EXPECT_EQ(std::ranges::adjacent_find(sorted), sorted.end()) << capacity;
        EXPECT_EQ(wrong_points(job, outcome) == 0, capacity == count);
    }
}

// What is stored lies in cells that discs touch, and the light is that of all photons.
TEST(PhotonGather, photons_that_no_point_could_take_are_not_stored) {
    PhotonJob job = random_job(11, {0, 0, 0}, 5.0, 1);
    job.setup.extent = 60.0;
    job.setup.buckets = 1u << 18;  // so that few cells share a mark
    TestRandom random(12);
    for (gpu::PhotonIn& photon : job.photons) {
        photon.is_stored = 1;
        if (random.bits32() % 4 != 0) photon.position.x += 40.0f;
    }
    const auto near = std::ranges::count_if(job.photons, [](const auto& p) { return p.position.x < 20.0f; });
    const PhotonOutcome outcome = test::run_photons(job);
    EXPECT_EQ(wrong_points(job, outcome), 0);
    EXPECT_EQ(outcome.head.count, outcome.counters[gpu::kWorkPhotonsStored]);
    EXPECT_LE(outcome.head.count, near);
    EXPECT_GT(outcome.head.count, near / 2);
    // Negative control: leaving out a photon that a point accepts is noticed.
    const auto taken = std::ranges::find_if(job.photons, [&](const gpu::PhotonIn& photon) {
        return std::ranges::any_of(job.points, [&](const gpu::Hit& point) {
            return glm::distance(photon.position, gpu::photon_position(point)) < 0.6 * job.setup.radius;
        });
    });
    ASSERT_NE(taken, job.photons.end());
    PhotonJob without = job;
    without.photons[static_cast<std::size_t>(taken - job.photons.begin())].is_stored = 0;
    EXPECT_GT(wrong_points(job, test::run_photons(without)), 0);
}

// Invocations that take several places and fill one leave holes behind.
TEST(PhotonGather, places_that_hold_no_photon_change_nothing) {
    PhotonJob job = random_job(14, {0, 0, 0}, 5.0, 2);
    const PhotonOutcome want = test::run_photons(job);
    job.slots_at_once = 16;
    job.setup.capacity = 16 * 3000;
    const PhotonOutcome gathered = test::run_photons(job);
    expect_no_faults(gathered);
    EXPECT_EQ(gathered.counters[gpu::kWorkPhotonsStored], want.head.count);
    EXPECT_EQ(gathered.head.count, 16 * want.head.count);
    EXPECT_TRUE(same_light(want, gathered));
    EXPECT_TRUE(same_light(want, test::run_splat(job)));
}

// Subgroups whose size the host knows, and subgroups whose size only the device knows.
TEST(PhotonGather, light_does_not_depend_on_who_knows_the_size_of_subgroups) {
    PhotonJob job = random_job(13, {0, 0, 0}, 5.0, 2);
    const PhotonOutcome known = test::run_photons(job);
    job.knows_lanes = false;
    const PhotonOutcome unknown = test::run_photons(job);
    EXPECT_EQ(wrong_points(job, unknown), 0);
    EXPECT_TRUE(same_light(known, unknown));
}

TEST(PhotonGather, no_photons_are_no_light) {
    PhotonJob job = random_job(9, {0, 0, 0}, 5.0, 2);
    for (gpu::PhotonIn& photon : job.photons)
        photon.is_stored = 0;
    const PhotonOutcome outcome = test::run_photons(job);
    expect_no_faults(outcome);
    for (std::size_t i = 0; i < outcome.light.size(); ++i)
        ASSERT_EQ(outcome.light[i] + outcome.half_area[i], glm::vec3(0.0f));
    EXPECT_TRUE(same_light(outcome, test::run_splat(job)));
}

TEST(PhotonGather, all_photons_in_one_place_are_summed_exactly) {
    PhotonJob job = random_job(9, {0, 0, 0}, 1.0, 1);
    for (gpu::PhotonIn& photon : job.photons)
        photon.position = glm::vec3(0.25f);
    for (std::size_t i = 0; i < job.points.size(); ++i)
        job.points[i] = sphere_point(glm::vec3(0.25f), i % 2 == 0 ? 0 : 1);
    const PhotonOutcome outcome = test::run_photons(job);
    EXPECT_EQ(wrong_points(job, outcome), 0);
    EXPECT_GT(outcome.light[0].x, 0.0f);
    EXPECT_EQ(outcome.light[1], glm::vec3(0.0f));
}

TEST(PhotonGather, a_radius_below_the_least_is_the_least) {
    PhotonJob job = random_job(9, {0, 0, 0}, 3e-4, 1);
    job.setup.radius = 0.0;
    const PhotonOutcome outcome = test::run_photons(job);
    EXPECT_EQ(wrong_points(job, outcome), 0);
    EXPECT_EQ(photon_params(job.setup).radius, gpu::kMinPhotonRadius);
    for (const glm::vec3& light : outcome.light)
        ASSERT_TRUE(std::isfinite(light.x + light.y + light.z));
}

TEST(PhotonGather, bad_powers_and_places_are_counted_and_never_spread) {
    PhotonJob job = random_job(9, {0, 0, 0}, 5.0, 2);
    job.photons.resize(100);
    for (gpu::PhotonIn& photon : job.photons)
        photon.is_stored = 1;
    job.photons[3].power.x = std::nanf("");
    job.photons[14].power.y = -1.0f;
    job.photons[15].power.z = INFINITY;
    job.photons[92].power.x = 3.5f;  // above the largest
    job.photons[65].position.y = std::nanf("");
    job.photons[35].position.x = -INFINITY;
    const PhotonOutcome outcome = test::run_photons(job);
    EXPECT_EQ(outcome.counters[gpu::kFaultPhotonPower], 6u);
    for (const glm::vec3& light : outcome.light)
        ASSERT_TRUE(std::isfinite(light.x + light.y + light.z));
}

// Photons on the two sides of a wall one voxel thick, and on the floor and the wall of a corner, meet no
// points but those of their own face.
TEST(PhotonGather, light_leaks_neither_through_a_wall_nor_round_a_corner) {
    PhotonJob job;
    job.setup = {.radius = 3.0, .extent = 32.0, .max_power = glm::dvec3(1.0), .buckets = 16, .capacity = 64};
    for (std::uint32_t face = 0; face < 6; ++face) {
        gpu::Hit hit{.cell = {4, 4, 4}, .face = face, .fraction = glm::vec3(0.5f)};
        hit.fraction[static_cast<int>(face / 2)] = static_cast<float>(face % 2);
        job.points.push_back(hit);
    }
    for (std::size_t lit = 0; lit < 6; ++lit) {
        job.photons = {{gpu::photon_position(job.points[lit]), gpu::photon_surface(job.points[lit]),
                        glm::vec3(0.5f), 1u}};
        const PhotonOutcome outcome = test::run_photons(job);
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_EQ(outcome.light[i].x > 0.0f, i == lit) << i << ", " << lit;
    }
}

// A floor and a wall of the scenes' kind, the point half a radius from the wall: what the wall takes of the
// disc is missing from the area.
TEST(PhotonGather, light_beside_a_wall_is_divided_by_the_share_that_the_wall_leaves) {
    PhotonJob job;
    job.setup = {.radius = 2.0, .extent = 20.0, .max_power = glm::dvec3(1.0), .buckets = 16, .capacity = 64};
    job.points = {sphere_point({1.0f, 5.0f, 0.0f}, 0)};
    job.photons = {{{1.25f, 5.0f, 0.0f}, gpu::photon_surface(job.points[0]), glm::vec3(0.5f), 1u}};
    const PhotonOutcome open = test::run_photons(job);
    job.spheres = {{gpu::sphere_anchored_near({0, 0, 1e4}, 1e4, {0, 0, 0}), 0},
                   {gpu::sphere_anchored_near({1e4, 0, 0}, 1e4, {0, 0, 0}), 0}};
    const PhotonOutcome walled = test::run_photons(job);
    const double left =
        2.0 / 3.0 + std::sqrt(3.0) / (4.0 * std::numbers::pi);  // of a line at half the radius
    EXPECT_NEAR(double{walled.light[0].x} / double{open.light[0].x} * left, 1.0, 1e-3);
    EXPECT_GT(walled.half_area[0].x, open.half_area[0].x);
    EXPECT_TRUE(same_light(walled, test::run_splat(job)));
    // Far balls take nothing of the disc, but make the pass look for the wall in the hierarchy.
    for (int i = 0; i < 20; ++i)
        job.spheres.push_back({gpu::sphere_anchored_near({8.0, 8.0, 2.0 * i + 8.0}, 0.5, {0, 0, 0}), 0});
    ASSERT_TRUE(test::photon_plan(job).has_sphere_tree());
    const PhotonOutcome found = test::run_photons(job);
    EXPECT_TRUE(same_light(found, walled));
    EXPECT_TRUE(same_light(found, test::run_splat(job)));
}

// Shares of many spheres, whose product depends on the order in its last bits.
TEST(PhotonGather, spheres_that_a_hierarchy_finds_take_of_discs_in_the_order_of_the_list) {
    PhotonJob job = random_job(31, {0, 0, 0}, 3.0, 4);
    TestRandom random(32);
    while (job.spheres.size() < gpu::kFewSpheres) {
        const glm::dvec3 centre(random_vec(random, -3.0, 3.0));
        job.spheres.push_back({gpu::sphere_anchored_near(centre, random.uniform(0.3, 2.0), {0, 0, 0}), 0});
    }
    const PhotonOutcome listed = test::run_photons(job);
    PhotonJob turned = job;  // all but the four that points are on
    std::reverse(turned.spheres.begin() + 4, turned.spheres.end());
    EXPECT_FALSE(same_light(test::run_photons(turned), listed));
    for (int i = 0; i < 20; ++i)
        job.spheres.push_back({gpu::sphere_anchored_near({20.0, 20.0, 2.0 * i}, 0.5, {0, 0, 0}), 0});
    ASSERT_TRUE(test::photon_plan(job).has_sphere_tree());
    EXPECT_TRUE(same_light(test::run_photons(job), listed));
    EXPECT_TRUE(same_light(test::run_splat(job), listed));
}

TEST(PhotonGather, workgroups_of_any_shape_give_the_same_bits) {
    const PhotonJob job = random_job(12, {0, 0, 0}, 6.0, 2);
    const PhotonOutcome want = test::run_photons(job);
    for (const std::array<std::uint32_t, 2> size :
         {std::array{16u, 16u}, std::array{4u, 2u}, std::array{3u, 5u}}) {
        Executor executor(test_device(), all_shaders(), {.group_size = size, .poison_transients = true});
        EXPECT_TRUE(same_light(want, test::run_photons(job, executor))) << size[0];
        EXPECT_TRUE(same_light(want, test::run_splat(job, executor))) << size[0];
    }
}

// Photons of a surface within a squared radius of a point.
double photons_within(const PhotonJob& job, const gpu::Hit& hit, double squared) {
    double count = 0.0;
    for (const gpu::PhotonIn& photon : job.photons) {
        const glm::dvec3 away = glm::dvec3(photon.position) - glm::dvec3(gpu::photon_position(hit));
        const bool counts = photon.is_stored != 0 && photon.surface == gpu::photon_surface(hit);
        count += counts && glm::dot(away, away) <= squared ? 1.0 : 0.0;
    }
    return count;
}

// The paper's statistics in double precision, flux included: its estimate is the mean of what the passes
// gave.
TEST(PhotonGather, radii_of_pixels_shrink_as_the_paper_says_and_the_mean_is_its_estimate) {
    PhotonJob job = random_job(21, {0, 0, 0}, 10.0, 1);
    job.radii = PhotonRadii::own;
    job.points.resize(64);
    std::vector<double> squared(64, job.setup.radius * job.setup.radius), met(64, 0.0), flux(64, 0.0),
        sum(64, 0.0);
    for (std::uint32_t iteration = 1; iteration <= 4; ++iteration) {
        job.photons = random_job(100 + iteration, {0, 0, 0}, 10.0, 1).photons;
        job.setup.iteration = iteration;
        const PhotonOutcome outcome = test::run_photons(job);
        for (std::size_t i = 0; i < 64; ++i) {
            const double m = photons_within(job, job.points[i], squared[i]);
            const double phi =
                light_at(job, job.points[i], std::sqrt(squared[i])).light.x * std::numbers::pi * squared[i];
            const double ratio = m > 0.0 ? (met[i] + job.setup.alpha * m) / (met[i] + m) : 1.0;
            flux[i] = (flux[i] + phi) * ratio;
            squared[i] *= ratio;
            met[i] += job.setup.alpha * m;
            sum[i] += double{outcome.light[i].x};
            ASSERT_NEAR(double{outcome.radii[i].squared} / squared[i], 1.0, 1e-5) << i << ", " << iteration;
            const double estimate = flux[i] / (std::numbers::pi * squared[i]);
            ASSERT_NEAR(sum[i], estimate, 1e-5 * estimate) << i << ", " << iteration;
        }
    }
    EXPECT_LT(squared[0], 0.9 * job.setup.radius * job.setup.radius);
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
