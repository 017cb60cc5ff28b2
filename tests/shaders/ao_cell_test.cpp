// Cells of the ambient occlusion hash and their keys.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <set>
#include <vector>

#include "support/ao_keys.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

using gpu::AoCell;
using gpu::kAoLevels;
using gpu::kAoMaxEdge;
using test::TestRandom;

constexpr float kBelowOne = 0x1.fffffep-1f;

bool is_same(const AoCell& a, const AoCell& b) {
    return a.voxel == b.voxel && a.face == b.face && a.level == b.level && a.part == b.part;
}

std::uint32_t below(TestRandom& random, std::uint32_t end) {
    return static_cast<std::uint32_t>(random.bits64() % end);
}

int coordinate(TestRandom& random) {
    static constexpr std::array<int, 8> kEdges{0,     1,     16383,          16384,
                                               16385, 65536, kAoMaxEdge - 2, kAoMaxEdge - 1};
    const std::uint32_t choice = below(random, 16);
    return choice < kEdges.size() ? kEdges[choice] : static_cast<int>(below(random, kAoMaxEdge));
}

AoCell random_cell(TestRandom& random) {
    AoCell cell{};
    cell.voxel = {coordinate(random), coordinate(random), coordinate(random)};
    cell.face = below(random, 6);
    cell.level = below(random, kAoLevels);
    cell.part = {below(random, 1u << cell.level), below(random, 1u << cell.level)};
    return cell;
}

// Every cell of the six faces of a voxel.
std::vector<AoCell> cells_of(glm::ivec3 voxel) {
    std::vector<AoCell> cells;
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (std::uint32_t level = 0; level < kAoLevels; ++level) {
            for (std::uint32_t part = 0; part < 1u << (2 * level); ++part)
                cells.push_back({voxel, face, level, {part % (1u << level), part >> level}});
        }
    }
    return cells;
}

// The corners of the largest world, voxels that differ from its first in one bit, and some between.
std::vector<AoCell> many_cells() {
    std::set<std::array<int, 3>> voxels;
    for (int corner = 0; corner < 8; ++corner) {
        const auto end = [&](int bit) { return (corner >> bit & 1) != 0 ? kAoMaxEdge - 1 : 0; };
        voxels.insert({end(0), end(1), end(2)});
    }
    for (int bit = 0; bit < 17; ++bit)
        voxels.insert({{1 << bit, 0, 0}, {0, 1 << bit, 0}, {0, 0, 1 << bit}});
    TestRandom random(11);
    while (voxels.size() < 90)
        voxels.insert({coordinate(random), coordinate(random), coordinate(random)});
    std::vector<AoCell> cells;
    for (const auto& [x, y, z] : voxels) {
        const std::vector<AoCell> some = cells_of({x, y, z});
        cells.insert(cells.end(), some.begin(), some.end());
    }
    return cells;
}

// The number of keys that belong to more than one cell.
template <class Key>
std::size_t repeats(const std::vector<AoCell>& cells, const Key& key) {
    std::vector<std::uint64_t> keys;
    std::ranges::transform(cells, std::back_inserter(keys), key);
    std::ranges::sort(keys);
    const auto end = std::unique(keys.begin(), keys.end());
    return cells.size() - static_cast<std::size_t>(end - keys.begin());
}

TEST(AoCellKey, different_cells_have_different_keys) {
    const std::vector<AoCell> cells = many_cells();
    ASSERT_EQ(cells.size(), 90u * 6u * gpu::kAoFaceParts);
    EXPECT_EQ(repeats(cells, test::key_of), 0u);
}

TEST(AoCellKey, comparison_rejects_keys_that_forget_a_bit) {
    const std::vector<AoCell> cells = many_cells();
    for (int bit = 0; bit < 63; ++bit) {
        if (bit == 31) continue;  // set in every key
        const auto forgetful = [&](const AoCell& cell) {
            return test::key_of(cell) & ~(std::uint64_t{1} << bit);
        };
        EXPECT_GT(repeats(cells, forgetful), 0u) << bit;
    }
}

TEST(AoCellKey, both_words_have_their_top_bit) {
    for (const AoCell& cell : many_cells()) {
        const gpu::uvec2 key = gpu::ao_cell_key(cell);
        ASSERT_TRUE((key.x & key.y & 0x80000000u) != 0u);
    }
}

TEST(AoCellKey, cell_is_read_back_from_its_bits) {
    for (const AoCell& cell : many_cells()) {
        const auto back = test::cell_of_key(test::key_of(cell));
        ASSERT_TRUE(back && is_same(*back, cell));
    }
    TestRandom random(3);
    for (int i = 0; i < 200000; ++i) {
        const AoCell cell = random_cell(random);
        const auto back = test::cell_of_key(test::key_of(cell));
        ASSERT_TRUE(back && is_same(*back, cell));
    }
}

TEST(AoCellKey, comparison_rejects_a_neighbour) {
    AoCell cell = random_cell(*std::make_unique<TestRandom>(4));
    cell.voxel = {5, 6, 7};
    AoCell other = cell;
    ++other.voxel.y;
    EXPECT_FALSE(is_same(*test::cell_of_key(test::key_of(other)), cell));
    EXPECT_FALSE(test::cell_of_key(test::key_of(cell) & 0x7FFFFFFFFFFFFFFFu));
    EXPECT_FALSE(test::cell_of_key(test::key_of(cell) & ~std::uint64_t{0x80000000u}));
}

// Points mirrored about the middle of the world: the voxel of each is its floor, also below zero.
template <class Floor>
std::size_t mirrored_repeats(const Floor& whole) {
    TestRandom random(5);
    std::size_t count = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 point(random.uniform(0.01, 3.0), random.uniform(0.01, 60000.0),
                               random.uniform(0.01, 1.0));
        std::vector<AoCell> images;
        for (int mirror = 0; mirror < 8; ++mirror) {
            const glm::dvec3 sign((mirror & 1) != 0 ? -1 : 1, (mirror & 2) != 0 ? -1 : 1,
                                  (mirror & 4) != 0 ? -1 : 1);
            const glm::dvec3 image = sign * point;
            const glm::ivec3 voxel(whole(image.x), whole(image.y), whole(image.z));
            const glm::dvec3 fraction = glm::clamp(glm::abs(image - glm::dvec3(voxel)), 0.0, 1.0);
            images.push_back(
                gpu::ao_cell(voxel + kAoMaxEdge / 2, 5u, glm::vec3(fraction), i % 2 == 0 ? 0u : 4u));
        }
        count += repeats(images, test::key_of);
    }
    return count;
}

TEST(HardCase, row20_mirrored_positions_have_cells_of_their_own) {
    EXPECT_EQ(mirrored_repeats([](double x) { return static_cast<int>(std::floor(x)); }), 0u);
}

TEST(HardCase, row20_comparison_rejects_positions_cut_towards_zero) {
    EXPECT_GT(mirrored_repeats([](double x) { return static_cast<int>(x); }), 1000u);
}

// Empty when a point lies in its cell, border included, and exactly on the face.
std::string misplaced(const AoCell& cell, glm::vec3 point) {
    if (point[static_cast<int>(cell.face / 2)] != static_cast<float>(cell.face % 2)) return "off the face";
    const double parts = std::ldexp(1.0, static_cast<int>(cell.level));
    const glm::dvec2 place(glm::dvec2(point[test::axis_u(cell.face)], point[test::axis_v(cell.face)]) *
                               parts -
                           glm::dvec2(cell.part));
    const bool inside = place.x >= 0.0 && place.x <= 1.0 && place.y >= 0.0 && place.y <= 1.0;
    return inside ? "" : "outside the cell";
}

TEST(AoCellPoint, point_lies_in_its_cell_exactly_on_the_face) {
    TestRandom random(6);
    const auto coordinate_in_cell = [&] {
        static constexpr std::array<float, 5> kEnds{0.0f, 1.0f, kBelowOne, 0x1p-24f, 0.5f};
        const std::uint32_t choice = below(random, 10);
        return choice < kEnds.size() ? kEnds[choice] : static_cast<float>(below(random, 1u << 24)) * 0x1p-24f;
    };
    for (int i = 0; i < 200000; ++i) {
        const AoCell cell = random_cell(random);
        const glm::vec2 u(coordinate_in_cell(), coordinate_in_cell());
        const glm::vec3 point = gpu::ao_cell_point(cell, u);
        ASSERT_EQ(misplaced(cell, point), "") << u.x << " " << u.y;
        const bool is_inner = u.x >= 0x1p-20f && u.x < 0.999f && u.y >= 0x1p-20f && u.y < 0.999f;
        if (is_inner) {
            ASSERT_TRUE(is_same(gpu::ao_cell(cell.voxel, cell.face, point, cell.level), cell));
        }
    }
}

TEST(AoCellPoint, comparison_rejects_a_point_of_the_next_cell) {
    TestRandom random(7);
    const AoCell cell{{1, 2, 3}, 2u, 3u, {4, 5}};
    AoCell next = cell;
    ++next.part.x;
    EXPECT_NE(misplaced(next, gpu::ao_cell_point(cell, {0.5f, 0.5f})), "");
    next = cell;
    next.face = 3u;
    EXPECT_NE(misplaced(next, gpu::ao_cell_point(cell, {0.5f, 0.5f})), "");
    next = cell;
    next.part = {5, 4};
    EXPECT_NE(misplaced(next, gpu::ao_cell_point(cell, {0.5f, 0.5f})), "");
}

TEST(AoCellAround, fraction_of_a_face_is_in_the_cell_that_double_precision_finds) {
    TestRandom random(8);
    std::vector<float> fractions{0.0f, 1.0f, kBelowOne, 0x1p-149f, 0x1p-24f};
    for (int part = 1; part < 16; ++part) {
        const float border = static_cast<float>(part) / 16.0f;
        fractions.insert(fractions.end(),
                         {border, std::nextafter(border, 0.0f), std::nextafter(border, 1.0f)});
    }
    for (int i = 0; i < 40; ++i)
        fractions.push_back(static_cast<float>(random.uniform(0.0, 1.0)));
    for (std::uint32_t face = 0; face < 6; ++face) {
        for (std::uint32_t level = 0; level < kAoLevels; ++level) {
            for (const float a : fractions) {
                glm::vec3 fraction(0.25f);
                fraction[test::axis_u(face)] = a;
                fraction[test::axis_v(face)] =
                    fractions[below(random, static_cast<std::uint32_t>(fractions.size()))];
                fraction[static_cast<int>(face / 2)] = static_cast<float>(face % 2);
                const AoCell cell = gpu::ao_cell({9, 8, 7}, face, fraction, level);
                ASSERT_TRUE(is_same(cell, test::cell_around({9, 8, 7}, face, glm::dvec3(fraction), level)))
                    << a << " face " << face << " level " << level;
            }
        }
    }
}

TEST(AoLevel, level_is_the_largest_cell_not_wider_than_wanted) {
    for (int exponent = -8; exponent <= 8; ++exponent) {
        const float border = std::ldexp(1.0f, exponent);
        for (const float width :
             {border, std::nextafter(border, 0.0f), std::nextafter(border, 1e9f), 1.3f * border})
            EXPECT_EQ(gpu::ao_level(width), test::level_of(static_cast<double>(width))) << width;
    }
    TestRandom random(9);
    for (int i = 0; i < 100000; ++i) {
        const double width = std::exp2(random.uniform(-7.0, 3.0));
        ASSERT_EQ(gpu::ao_level(static_cast<float>(width)),
                  test::level_of(static_cast<double>(static_cast<float>(width))))
            << width;
    }
}

TEST(AoLevel, comparison_rejects_a_border_moved_by_one_ulp) {
    const float border = 0.25f;
    EXPECT_NE(gpu::ao_level(border), test::level_of(static_cast<double>(std::nextafter(border, 0.0f))));
    EXPECT_NE(gpu::ao_level(std::nextafter(border, 0.0f)), test::level_of(static_cast<double>(border)));
}

TEST(AoLevel, width_that_is_no_width_stays_in_range) {
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float width : {nan, -nan, inf, -inf, 0.0f, -0.0f, -1.0f, 1e-45f, 3e38f})
        EXPECT_LT(gpu::ao_level(width), kAoLevels) << width;
    EXPECT_EQ(gpu::ao_level(0.0f), kAoLevels - 1);
    EXPECT_EQ(gpu::ao_level(inf), 0u);
}

}  // namespace
}  // namespace voxilux
