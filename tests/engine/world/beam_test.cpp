// beam.h: rays that start where their beam ends must meet what they meet from the camera, bit for bit.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "support/ray_families.h"
#include "world/march_world.h"
#include "world/world_view.h"
// After the world's, which says how C++ reads it.
#include "shared/camera.h"
#include "support/traversal_name.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kSeed = 20267;
constexpr int kCameras = 8;

gpu::FrameParams camera_at(glm::dvec3 position, glm::vec3 forward, float half_height) {
    const glm::vec3 aside = std::abs(forward.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
    const glm::vec3 right = glm::normalize(glm::cross(forward, aside));
    gpu::FrameParams params{};
    params.camera_cell = glm::ivec3(glm::floor(position));
    params.camera_fraction = glm::vec3(position - glm::floor(position));
    params.camera_forward = forward;
    params.camera_right = right * half_height * 1.5f;
    params.camera_up = glm::cross(right, forward) * half_height;
    params.width = 36;
    params.height = 24;
    params.seed = kSeed;
    return params;
}

// Cameras in and around a world, near and far, from narrow to very wide, that look at a point of it.
std::vector<gpu::FrameParams> cameras_around(glm::ivec3 size, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto point = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
    std::vector<gpu::FrameParams> cameras;
    for (int i = 0; i < kCameras; ++i) {
        const double reach = i < kCameras / 2 ? 1.0 : std::pow(10.0, 5.0 * unit(random));
        const glm::dvec3 position = ((point() - 0.5) * reach + 0.5) * glm::dvec3(size);
        const glm::dvec3 target = point() * glm::dvec3(size);
        const double half_height = std::pow(10.0, 2.5 * unit(random) - 1.5) / reach;
        cameras.push_back(camera_at(position, glm::vec3(glm::normalize(target - position)),
                                    static_cast<float>(half_height)));
    }
    return cameras;
}

struct Comparison {
    int rays = 0;
    int hits = 0;
    int differing = 0;
    std::uint64_t steps = 0;  // from the camera
    std::uint64_t steps_saved = 0;
    std::string first;
};

bool is_same(const gpu::MarchHit& a, const gpu::MarchHit& b) {
    if (a.face != b.face || a.fault != b.fault) return false;
    return a.face == gpu::kFaceMiss ||
           (a.cell == b.cell && a.t == b.t && a.crossed == b.crossed && a.material == b.material);
}

// Marches every ray of the picture from the camera and from its beam's end. `moved` changes where that is.
void compare_starts(const MarchWorld& world, gpu::FrameParams camera,
                    const std::function<float(float)>& moved, Comparison& sum,
                    gpu::uint projection = gpu::kPerspective) {
    for (gpu::uint pixel = 0; pixel < camera.width * camera.height; ++pixel) {
        const gpu::uint x = pixel % camera.width;
        const gpu::uint y = pixel / camera.width;
        const gpu::Beam beam =
            gpu::tile_beam(camera, projection, x - x % gpu::kBeamPixels, y - y % gpu::kBeamPixels);
        const float start = moved(gpu::beam_start(world, beam, world.chunks_size));
        const gpu::WorldEntry entry =
            gpu::enter_world(gpu::camera_ray(camera, projection, gpu::kSequenceWhite, x, y), world.size());
        if (!entry.enters) continue;
        const gpu::MarchHit want = gpu::march(world, entry.ray, world.chunks_size);
        const gpu::MarchHit hit = gpu::march_from(world, entry.ray, world.chunks_size, start - entry.t);
        ++sum.rays;
        sum.hits += want.face != gpu::kFaceMiss ? 1 : 0;
        sum.steps += want.steps;
        sum.steps_saved += want.steps - std::min(want.steps, hit.steps);
        if (is_same(hit, want)) continue;
        if (++sum.differing == 1)
            sum.first = fmt::format("pixel ({}, {}), start {} of {}", x, y, start - entry.t, want.t);
    }
}

float unmoved(float start) {
    return start;
}

// A floor with pillars, and stones in the air.
VoxelWorld sparse_world() {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(6, 5, 4));
    std::mt19937 random(kSeed);
    for (int x = 1; x < 95; ++x)
        for (int y = 1; y < 79; ++y)
            for (int z = 1; z < (x % 23 == 5 && y % 17 == 7 ? 40 : 4); ++z)
                world.set({x, y, z}, 1);
    for (int i = 0; i < 60; ++i) {
        const auto at = [&](int size) {
            return 1 + static_cast<int>(random() % static_cast<unsigned>(size - 2));
        };
        world.set({at(96), at(80), at(64)}, 2);
    }
    return world;
}

class BeamIn : public ::testing::TestWithParam<Traversal> {};

TEST_P(BeamIn, start_changes_no_hit_of_small_worlds) {
    Comparison sum;
    for (const test::NamedWorld& named : test::small_worlds(kSeed)) {
        const MarchWorld world = build_march_world(named.world, GetParam());
        for (const gpu::FrameParams& camera : cameras_around(world.size(), kSeed)) {
            compare_starts(world, camera, unmoved, sum);
            ASSERT_EQ(sum.differing, 0) << named.name << " " << sum.first;
        }
    }
    EXPECT_GT(sum.hits, 1000);
}

TEST_P(BeamIn, start_changes_no_hit_of_a_sparse_world) {
    const MarchWorld world = build_march_world(sparse_world(), GetParam());
    Comparison sum;
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        for (const gpu::FrameParams& camera : cameras_around(world.size(), seed)) {
            compare_starts(world, camera, unmoved, sum);
            ASSERT_EQ(sum.differing, 0) << "seed " << seed << " " << sum.first;
        }
    }
    EXPECT_GT(sum.hits, 10000);
}

// The same axes for other projections: blocks of four pixels, unit axes for panoramas.
gpu::FrameParams with_projection(gpu::FrameParams camera, gpu::uint projection) {
    camera.camera_block = 4;
    camera.camera_pixel = {3, 1};
    camera.camera_angle = 1.2f;
    if (projection == gpu::kThinLens) {
        camera.lens_radius = 1.5f;
        camera.lens_power = 1.0f / 24.0f;
    } else if (projection != gpu::kOrthographic) {
        camera.camera_right = glm::normalize(camera.camera_right);
        camera.camera_up = glm::normalize(camera.camera_up);
    }
    return camera;
}

TEST_P(BeamIn, start_changes_no_hit_of_other_projections) {
    const MarchWorld world = build_march_world(sparse_world(), GetParam());
    for (const gpu::uint projection :
         {gpu::kOrthographic, gpu::kEquirectangular, gpu::kFisheye, gpu::kThinLens}) {
        Comparison sum;
        for (std::uint32_t seed = 0; seed < 8; ++seed) {
            for (const gpu::FrameParams& camera : cameras_around(world.size(), seed)) {
                compare_starts(world, with_projection(camera, projection), unmoved, sum, projection);
                ASSERT_EQ(sum.differing, 0) << projection << " seed " << seed << " " << sum.first;
            }
        }
        EXPECT_GT(sum.hits, 1000) << projection;
    }
}

INSTANTIATE_TEST_SUITE_P(Traversals, BeamIn,
                         ::testing::ValuesIn(all_traversals().begin(), all_traversals().end()),
                         test::traversal_name);

// Rays of the tile whose upper left pixel is (x, y) that its beam does not hold.
int rays_outside(const gpu::FrameParams& camera, gpu::uint projection, gpu::uint x, gpu::uint y) {
    const gpu::Beam beam = gpu::tile_beam(camera, projection, x, y);
    int outside = 0;
    for (gpu::uint i = 0; i <= 2 * gpu::kBeamPixels; ++i)
        for (gpu::uint j = 0; j <= 2 * gpu::kBeamPixels; ++j) {
            const float column = static_cast<float>(x) + 0.5f * static_cast<float>(i);
            const float row = static_cast<float>(y) + 0.5f * static_cast<float>(j);
            const glm::vec3 ray = gpu::panorama_direction(camera, projection, column, row);
            outside += glm::length(ray - beam.axis) > beam.spread ? 1 : 0;
        }
    return outside;
}

TEST(Beam, holds_every_ray_of_panoramas_of_any_angle) {
    for (const gpu::uint projection : {gpu::kEquirectangular, gpu::kFisheye})
        for (const float degrees : {20.0f, 180.0f, 250.0f, 300.0f, 360.0f}) {
            gpu::FrameParams camera =
                with_projection(camera_at({2.5, 2.5, 2.5}, {1, 0, 0}, 0.4f), projection);
            camera.width = 320;
            camera.height = 180;
            camera.camera_angle = glm::radians(degrees / 2.0f);
            int outside = 0;
            for (gpu::uint y = 0; y < camera.height; y += gpu::kBeamPixels)
                for (gpu::uint x = 0; x < camera.width; x += gpu::kBeamPixels)
                    outside += rays_outside(camera, projection, x, y);
            EXPECT_EQ(outside, 0) << projection << ", " << degrees;
        }
}

// A picture from above the sparse world, fine enough for its tiles to be narrow.
gpu::FrameParams view_from_above() {
    gpu::FrameParams camera = camera_at({4.2, 5.1, 60.3}, glm::normalize(glm::vec3(1, 0.8f, -0.8f)), 0.4f);
    camera.width = 216;
    camera.height = 144;
    return camera;
}

TEST(Beam, saves_steps_where_boxes_cross_borders) {
    for (const Traversal traversal : {Traversal::deep, Traversal::wide}) {
        const MarchWorld world = build_march_world(sparse_world(), traversal);
        Comparison sum;
        compare_starts(world, view_from_above(), unmoved, sum);
        EXPECT_GT(sum.hits, sum.rays / 2);
        EXPECT_GT(static_cast<double>(sum.steps_saved), 0.1 * static_cast<double>(sum.steps))
            << name_of(traversal);
    }
}

TEST(Beam, saves_steps_of_parallel_rays) {
    const MarchWorld world = build_march_world(sparse_world(), Traversal::wide);
    gpu::FrameParams camera = with_projection(view_from_above(), gpu::kOrthographic);
    camera.camera_cell = {-20, -20, 100};
    Comparison sum;
    compare_starts(world, camera, unmoved, sum, gpu::kOrthographic);
    EXPECT_GT(sum.hits, 1000);
    EXPECT_GT(static_cast<double>(sum.steps_saved), 0.1 * static_cast<double>(sum.steps));
}

// Negative control of all tests that find no difference.
TEST(Beam, late_starts_are_caught) {
    const MarchWorld world = build_march_world(sparse_world(), Traversal::wide);
    Comparison sum;
    compare_starts(
        world, view_from_above(), [](float start) { return start + 12.0f; }, sum);
    EXPECT_GT(sum.differing, sum.rays / 20);
}

TEST(Beam, ends_not_far_before_a_wall) {
    VoxelWorld voxels(glm::ivec3(0), glm::ivec3(20, 4, 4));
    for (int y = 1; y < 63; ++y)
        for (int z = 1; z < 63; ++z)
            voxels.set({300, y, z}, 0);
    for (const Traversal traversal : {Traversal::naadf, Traversal::deep, Traversal::wide}) {
        const MarchWorld world = build_march_world(voxels, traversal);
        const gpu::FrameParams camera = camera_at({2.5, 32.5, 32.5}, {1, 0, 0}, 0.05f);
        const float start =
            gpu::beam_start(world, gpu::tile_beam(camera, gpu::kPerspective, 16, 8), world.chunks_size);
        EXPECT_GT(start, 297.5f - 24.0f) << name_of(traversal);  // a chunk and a half
        EXPECT_LT(start, 297.5f);
    }
}

TEST(Beam, never_ends_in_an_empty_world_or_beside_one) {
    VoxelWorld voxels(glm::ivec3(0), glm::ivec3(3, 3, 3));
    const MarchWorld empty = build_march_world(voxels, Traversal::wide);
    const gpu::FrameParams inside = camera_at({20.5, 20.5, 20.5}, {0, 1, 0}, 0.3f);
    EXPECT_EQ(gpu::beam_start(empty, gpu::tile_beam(inside, gpu::kPerspective, 8, 8), empty.chunks_size),
              gpu::kUnbounded);
    voxels.set({24, 24, 24}, 0);
    const MarchWorld world = build_march_world(voxels, Traversal::wide);
    const gpu::FrameParams beside = camera_at({-500.5, 24.5, 24.5}, {0, 1, 0}, 0.3f);
    EXPECT_EQ(gpu::beam_start(world, gpu::tile_beam(beside, gpu::kPerspective, 8, 8), world.chunks_size),
              gpu::kUnbounded);
    const gpu::FrameParams towards = camera_at({-500.5, 24.5, 24.5}, {1, 0, 0}, 0.3f);
    EXPECT_LT(gpu::beam_start(world, gpu::tile_beam(towards, gpu::kPerspective, 16, 8), world.chunks_size),
              525.0f)
        << "negative control";
}

TEST(Beam, starts_at_the_camera_inside_a_solid_or_when_it_is_too_wide) {
    VoxelWorld voxels(glm::ivec3(0), glm::ivec3(3, 3, 3));
    voxels.set({20, 20, 20}, 0);
    const MarchWorld world = build_march_world(voxels, Traversal::wide);
    const gpu::FrameParams inside = camera_at({20.5, 20.5, 20.5}, {0, 1, 0}, 0.3f);
    EXPECT_EQ(gpu::beam_start(world, gpu::tile_beam(inside, gpu::kPerspective, 8, 8), world.chunks_size),
              0.0f);
    gpu::FrameParams wide = camera_at({-20.5, 20.5, 20.5}, {-1, 0, 0}, 100.0f);
    wide.width = 4;
    wide.height = 4;
    EXPECT_EQ(gpu::beam_start(world, gpu::tile_beam(wide, gpu::kPerspective, 0, 0), world.chunks_size), 0.0f);
}

}  // namespace
}  // namespace voxilux
