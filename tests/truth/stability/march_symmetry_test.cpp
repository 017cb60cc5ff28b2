// Hard cases 6 and 7 of the march: scenes that are mirrored, permuted, shifted or scaled, with their rays.
//
// What holds, for fractions f whose 1 - f is exact (here multiples of 2^-12):
// - Mirrored: the same hit bit for bit, up to the symmetry. A ray carries its cell, so mirroring keeps every
//   crossing time, and ties go by axis alone.
// - Permuted: the same hit bit for bit for a ray whose hit no tie decides. Ties are crossed x before y before
//   z, which is another order in the axes of the original scene: a walk in that order checks them.
// - Shifted by whole voxels: every bit but the cell. Directions scaled by a power of two: every bit but the
//   time, which is scaled exactly. Scenes scaled by a power of two: the time is scaled exactly, too.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "scene/scene.h"
#include "support/exact_walk.h"
#include "support/march_oracle.h"
#include "support/traversal_name.h"
#include "truth/stability/march_checkers.h"

namespace voxilux {
namespace {

// A mirroring and permutation of the axes of a world of `size` cells.
struct Symmetry {
    Rotation rotation;
    glm::ivec3 size;

    [[nodiscard]] std::size_t source(int axis) const { return rotation.axis[static_cast<std::size_t>(axis)]; }
    [[nodiscard]] bool is_mirrored(int axis) const {
        return rotation.sign[static_cast<std::size_t>(axis)] < 0;
    }

    [[nodiscard]] glm::ivec3 permuted(glm::ivec3 v) const {
        return {v[rotation.axis[0]], v[rotation.axis[1]], v[rotation.axis[2]]};
    }
    [[nodiscard]] glm::ivec3 cell(glm::ivec3 c) const {
        glm::ivec3 moved = permuted(c);
        const glm::ivec3 last = permuted(size) - 1;
        for (int a = 0; a < 3; ++a)
            if (is_mirrored(a)) moved[a] = last[a] - moved[a];
        return moved;
    }
    [[nodiscard]] gpu::Ray ray(const gpu::Ray& ray) const {
        gpu::Ray moved = ray;
        moved.cell = cell(ray.cell);
        for (int a = 0; a < 3; ++a) {
            const int from = rotation.axis[static_cast<std::size_t>(a)];
            moved.fraction[a] = is_mirrored(a) ? 1.0f - ray.fraction[from] : ray.fraction[from];
            moved.direction[a] = is_mirrored(a) ? -ray.direction[from] : ray.direction[from];
        }
        return moved;
    }
    [[nodiscard]] gpu::uint face(gpu::uint face) const {
        if (face >= gpu::kFaceInside) return face;
        gpu::uint axis = 0;
        while (source(static_cast<int>(axis)) != face >> 1u)
            ++axis;
        return 2 * axis + ((face & 1u) ^ (is_mirrored(static_cast<int>(axis)) ? 1u : 0u));
    }
    [[nodiscard]] gpu::MarchHit hit(gpu::MarchHit hit) const {
        if (hit.face == gpu::kFaceMiss) return hit;
        hit.cell = cell(hit.cell);
        hit.crossed = permuted(hit.crossed);
        hit.face = face(hit.face);
        return hit;
    }
    // Whether `moved` is the image of `fraction`: mirrored ones add up to 1, of which one side is rounded.
    [[nodiscard]] bool is_image(glm::vec3 moved, glm::vec3 fraction) const {
        for (int a = 0; a < 3; ++a) {
            const float f = fraction[rotation.axis[static_cast<std::size_t>(a)]];
            if (is_mirrored(a) ? moved[a] != 1.0f - f && f != 1.0f - moved[a] : moved[a] != f) return false;
        }
        return true;
    }
    // The tie rule of the moved scene in the axes of the original one.
    [[nodiscard]] test::AxisOrder order() const {
        return {rotation.axis[0], rotation.axis[1], rotation.axis[2]};
    }
};

std::vector<Symmetry> symmetries(glm::ivec3 size) {
    std::vector<Symmetry> all;
    std::array<std::uint8_t, 3> axes = {0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            Rotation rotation{.axis = axes};
            for (int a = 0; a < 3; ++a)
                rotation.sign[static_cast<std::size_t>(a)] = ((signs >> a) & 1) != 0 ? -1 : 1;
            all.push_back({rotation, size});
        }
    } while (std::next_permutation(axes.begin(), axes.end()));
    return all;
}

// Voxels without any symmetry, in 2 x 1 x 1 chunks.
VoxelWorld lopsided_world() {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(2, 1, 1));
    std::mt19937 dice(test::kMarchSeed);
    for (int i = 0; i < 150; ++i)
        world.set(glm::ivec3(glm::uvec3(dice(), dice(), dice()) % glm::uvec3(world.size())),
                  static_cast<std::uint16_t>(i));
    return world;
}

VoxelWorld moved_world(const VoxelWorld& world, const Symmetry& symmetry) {
    VoxelWorld moved(glm::ivec3(0), symmetry.permuted(world.chunks()));
    world.for_each_voxel([&](glm::ivec3 c, std::uint16_t voxel) {
        moved.set(symmetry.cell(c), static_cast<std::uint16_t>(voxel & gpu::kVoxelPayloadMask));
    });
    return moved;
}

std::vector<gpu::Ray> rays_on_a_grid(glm::ivec3 size, int count) {
    std::vector<gpu::Ray> rays = test::all_families(size, count);
    for (gpu::Ray& ray : rays)
        ray.fraction = glm::floor(ray.fraction * 4096.0f) / 4096.0f;
    return rays;
}

// Whether the order of planes that are met at the same time decides what the ray hits.
bool is_decided_by_ties(const VoxelWorld& world, const gpu::Ray& ray) {
    test::AxisOrder order = test::kTieRule;
    const gpu::MarchHit first = test::walk_cells(world, ray);
    while (std::ranges::next_permutation(order).found)
        if (!test::difference(test::walk_cells(world, ray, order), first).empty()) return true;
    return false;
}

class MarchSymmetry : public ::testing::TestWithParam<Traversal> {};

TEST_P(MarchSymmetry, row06_mirrored_and_permuted_scenes_give_the_same_hits_bit_for_bit) {
    const VoxelWorld world = lopsided_world();
    const std::vector<gpu::Ray> rays = rays_on_a_grid(world.size(), 100);
    const auto plain = test::march_on_device(build_march_world(world, GetParam()), rays);
    std::vector<bool> has_tie;
    for (const gpu::Ray& ray : rays)
        has_tie.push_back(is_decided_by_ties(world, ray));
    EXPECT_GT(std::ranges::count(has_tie, true), 20);
    for (const Symmetry& symmetry : symmetries(world.size())) {
        std::vector<gpu::Ray> moved;
        for (const gpu::Ray& ray : rays)
            moved.push_back(symmetry.ray(ray));
        const auto got =
            test::march_on_device(build_march_world(moved_world(world, symmetry), GetParam()), moved);
        const bool keeps_axes = symmetry.order() == test::kTieRule;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const gpu::MarchHit walked = test::walk_cells(world, rays[i], symmetry.order());
            ASSERT_EQ(test::difference(got[i].hit, symmetry.hit(walked)), "") << test::print(rays[i]);
            if (has_tie[i] && !keeps_axes) continue;
            ASSERT_EQ(test::difference(got[i].hit, symmetry.hit(plain[i].hit)), "") << test::print(rays[i]);
            ASSERT_TRUE(symmetry.is_image(got[i].fraction, plain[i].fraction) ||
                        plain[i].hit.face == gpu::kFaceMiss)
                << test::print(rays[i]);
        }
    }
}

TEST_P(MarchSymmetry, row06_ties_of_permuted_scenes_go_by_the_rule_in_exact_integers) {
    const VoxelWorld world = lopsided_world();
    std::vector<gpu::Ray> rays = test::family_named("corners", world.size(), 400);
    const std::vector<gpu::Ray> centred = test::family_named("diagonal_from_centre", world.size(), 400);
    rays.insert(rays.end(), centred.begin(), centred.end());
    int decided = 0;
    for (const Symmetry& symmetry : symmetries(world.size())) {
        std::vector<gpu::Ray> moved;
        for (const gpu::Ray& ray : rays)
            moved.push_back(symmetry.ray(ray));
        const auto got =
            test::march_on_device(build_march_world(moved_world(world, symmetry), GetParam()), moved);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const test::ExactHit want = test::exact_walk(world, rays[i], symmetry.order());
            const test::ExactHit unpermuted = test::exact_walk(world, rays[i]);
            ASSERT_EQ(got[i].hit.face, symmetry.face(want.face)) << test::print(rays[i]);
            if (want.face == gpu::kFaceMiss) continue;
            ASSERT_EQ(got[i].hit.cell, symmetry.cell(want.cell)) << test::print(rays[i]);
            decided += want.cell != unpermuted.cell || want.face != unpermuted.face ? 1 : 0;
        }
    }
    EXPECT_GT(decided, 1000);  // the order of the axes matters
}

INSTANTIATE_TEST_SUITE_P(HardCase, MarchSymmetry, ::testing::ValuesIn(all_traversals()),
                         test::traversal_name);

TEST(HardCase, row06_comparison_rejects_a_scene_mirrored_along_another_axis) {
    const VoxelWorld world = lopsided_world();
    const Symmetry symmetry{{.sign = {-1, 1, 1}}, world.size()};
    const Symmetry other{{.sign = {1, -1, 1}}, world.size()};
    int caught = 0;
    for (const gpu::Ray& ray : rays_on_a_grid(world.size(), 100)) {
        const gpu::MarchHit got = test::walk_cells(moved_world(world, other), other.ray(ray));
        caught += test::difference(got, symmetry.hit(test::walk_cells(world, ray))).empty() ? 0 : 1;
    }
    EXPECT_GT(caught, 100);
}

// All bits but those of the cells.
void expect_same_but_moved(const std::vector<gpu::MarchProbe>& got, const std::vector<gpu::MarchProbe>& plain,
                           glm::ivec3 shift) {
    for (std::size_t i = 0; i < got.size(); ++i) {
        gpu::MarchHit want = plain[i].hit;
        want.cell += shift;
        ASSERT_EQ(test::difference(got[i].hit, want), "") << i;
        ASSERT_EQ(got[i].fraction, plain[i].fraction) << i;
    }
}

TEST(HardCase, row07_shift_by_whole_voxels_keeps_every_bit) {
    const VoxelWorld& world = test::world_named("random_0.02");
    const std::vector<gpu::Ray> rays = test::all_families(world.size(), 400);
    const auto plain = test::march_everywhere(world, rays);
    for (const glm::ivec3 shift : {glm::ivec3(5, 11, 16), {1, 2, 3}, {16, 0, 15}, {3, 30, 4}}) {
        VoxelWorld shifted(glm::ivec3(0), world.chunks() + 2);
        world.for_each_voxel([&](glm::ivec3 c, std::uint16_t voxel) {
            shifted.set(c + shift, static_cast<std::uint16_t>(voxel & gpu::kVoxelPayloadMask));
        });
        std::vector<gpu::Ray> moved = rays;
        for (gpu::Ray& ray : moved)
            ray.cell += shift;
        expect_same_but_moved(test::march_everywhere(shifted, moved), plain, shift);
    }
}

// Components that count as zero before the scaling may count afterwards.
bool has_vanishing_component(glm::vec3 direction) {
    const glm::vec3 size = glm::abs(direction);
    return std::ranges::any_of(std::array{size.x, size.y, size.z},
                               [](float c) { return c > 0.0f && c < gpu::kMinDirection; });
}

TEST(HardCase, row07_directions_scaled_by_powers_of_two_keep_every_bit_but_scale_the_time) {
    const VoxelWorld& world = test::world_named("random_0.02");
    std::vector<gpu::Ray> rays = test::all_families(world.size(), 400);
    std::erase_if(rays, [](const gpu::Ray& ray) { return has_vanishing_component(ray.direction); });
    const auto plain = test::march_everywhere(world, rays);
    for (const float scale : {0x1p-30f, 0x1p-1f, 0x1p1f, 0x1p20f, 0x1p60f}) {
        std::vector<gpu::Ray> scaled = rays;
        for (gpu::Ray& ray : scaled) {
            ray.direction *= scale;
            ray.t_max = ray.t_max == gpu::kUnbounded ? gpu::kUnbounded : ray.t_max / scale;
        }
        const auto got = test::march_everywhere(world, scaled);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            gpu::MarchHit want = plain[i].hit;
            want.t /= scale;
            ASSERT_EQ(test::difference(got[i].hit, want), "") << scale << " " << test::print(rays[i]);
            ASSERT_EQ(got[i].fraction, plain[i].fraction) << scale << " " << test::print(rays[i]);
        }
    }
}

// Each voxel becomes a cube of scale^3.
VoxelWorld enlarged(const VoxelWorld& world, int scale) {
    VoxelWorld large(glm::ivec3(0), world.chunks() * scale);
    world.for_each_voxel([&](glm::ivec3 c, std::uint16_t voxel) {
        for (int i = 0; i < scale * scale * scale; ++i)
            large.set(c * scale + glm::ivec3(i % scale, i / scale % scale, i / scale / scale),
                      static_cast<std::uint16_t>(voxel & gpu::kVoxelPayloadMask));
    });
    return large;
}

gpu::Ray enlarged(gpu::Ray ray, int scale) {
    const auto factor = static_cast<float>(scale);
    const glm::vec3 within = ray.fraction * factor;
    const glm::vec3 whole = glm::min(glm::floor(within), factor - 1.0f);  // a fraction of 1 stays in its cell
    ray.cell = ray.cell * scale + glm::ivec3(whole);
    ray.fraction = within - whole;
    ray.t_max = std::min(ray.t_max, gpu::kUnbounded / factor) * factor;
    return ray;
}

TEST(HardCase, row07_scenes_scaled_by_powers_of_two_scale_the_time_exactly) {
    const VoxelWorld world = lopsided_world();
    const std::vector<gpu::Ray> rays = test::all_families(world.size(), 300);
    const auto plain = test::march_everywhere(world, rays);
    for (const int scale : {2, 4}) {
        std::vector<gpu::Ray> large;
        for (const gpu::Ray& ray : rays)
            large.push_back(enlarged(ray, scale));
        const auto got = test::march_everywhere(enlarged(world, scale), large);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(got[i].hit.face, plain[i].hit.face) << scale << " " << test::print(rays[i]);
            ASSERT_EQ(got[i].hit.t, plain[i].hit.t * static_cast<float>(scale)) << test::print(rays[i]);
            if (got[i].hit.face == gpu::kFaceMiss) continue;
            ASSERT_EQ(got[i].hit.cell / scale, plain[i].hit.cell) << test::print(rays[i]);
            ASSERT_EQ(got[i].hit.material, plain[i].hit.material);
        }
    }
}

}  // namespace
}  // namespace voxilux
