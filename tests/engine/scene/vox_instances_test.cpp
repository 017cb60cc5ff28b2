#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formats/vox_read.h"
#include "scene/vox_graph.h"
#include "scene/vox_instances.h"
#include "scene/vox_scene.h"
#include "support/vox_builder.h"

namespace voxilux {
namespace {

using namespace vox_builder;

struct Signed {
    Rotation rotation;
    glm::dmat3 matrix;  // columns, as GLM has them
};

// All 48 signed permutations with their matrices, built without Rotation's own arithmetic.
std::vector<Signed> all_signed_permutations() {
    std::vector<Signed> all;
    std::array<std::uint8_t, 3> axis{0, 1, 2};
    do {
        for (unsigned signs = 0; signs < 8; ++signs) {
            Signed s{.rotation = {.axis = axis}, .matrix = glm::dmat3(0.0)};
            for (std::size_t row = 0; row < 3; ++row) {
                s.rotation.sign[row] = (signs >> row & 1) != 0 ? std::int8_t{-1} : std::int8_t{1};
                s.matrix[axis[row]][static_cast<glm::length_t>(row)] = s.rotation.sign[row];
            }
            all.push_back(s);
        }
    } while (std::next_permutation(axis.begin(), axis.end()));
    return all;
}

// MagicaVoxel's rule in doubles: every value is a multiple of 1/2 and far below 2^52, so it is exact.
glm::ivec3 brute_force_cell(const glm::dmat3& matrix, glm::ivec3 translation, glm::ivec3 size, glm::ivec3 v) {
    const glm::dvec3 pivot = glm::floor(glm::dvec3(size) / 2.0);
    return glm::ivec3(glm::floor(matrix * (glm::dvec3(v) + 0.5 - pivot) + glm::dvec3(translation)));
}

constexpr glm::ivec3 kSizes[] = {{1, 1, 1}, {2, 2, 2}, {3, 4, 5}, {4, 3, 6}, {5, 5, 2}, {256, 1, 3}};

TEST(WorldCell, all_48_signed_permutations_equal_brute_force) {
    const auto all = all_signed_permutations();
    ASSERT_EQ(all.size(), 48u);
    for (const Signed& s : all) {
        for (const glm::ivec3 size : kSizes) {
            const Instance instance{.rotation = s.rotation, .translation = {7, -11, 200}};
            for (const glm::ivec3 v : {glm::ivec3(0), size - 1, glm::ivec3(size.x - 1, 0, size.z / 2)})
                ASSERT_EQ(world_cell(instance, size, v),
                          brute_force_cell(s.matrix, instance.translation, size, v));
        }
    }
}

// Negative control: the same rule without the half voxel is one cell off along every mirrored axis.
TEST(WorldCell, brute_force_without_the_half_voxel_differs) {
    int different = 0;
    for (const Signed& s : all_signed_permutations()) {
        const Instance instance{.rotation = s.rotation};
        const glm::ivec3 wrong(glm::floor(s.matrix * (glm::dvec3(0.0) - glm::dvec3(1, 2, 2))));
        different += world_cell(instance, {3, 4, 5}, glm::ivec3(0)) != wrong ? 1 : 0;
    }
    EXPECT_EQ(different, 42);  // all but the six without a mirrored axis
}

TEST(WorldCell, a_model_keeps_its_voxels_apart) {
    for (const Signed& s : all_signed_permutations()) {
        std::vector<std::array<int, 3>> cells;
        for (int x = 0; x < 3; ++x) {
            for (int y = 0; y < 4; ++y) {
                for (int z = 0; z < 2; ++z) {
                    const glm::ivec3 c = world_cell({.rotation = s.rotation}, {3, 4, 2}, {x, y, z});
                    cells.push_back({c.x, c.y, c.z});
                }
            }
        }
        std::sort(cells.begin(), cells.end());
        EXPECT_EQ(std::adjacent_find(cells.begin(), cells.end()), cells.end());
    }
}

// The byte of the format's own example: rows (0 1 0), (0 0 -1), (-1 0 0).
TEST(VoxRotation, published_example_is_decoded) {
    const auto rotation =
        parse_rotation(std::to_string((1 << 0) | (2 << 2) | (0 << 4) | (1 << 5) | (1 << 6)));
    ASSERT_TRUE(rotation);
    EXPECT_EQ(rotation.value().apply({10, 20, 30}), glm::ivec3(20, -30, -10));
}

TEST(VoxRotation, exactly_48_bytes_below_128_are_legal) {
    int legal = 0;
    for (int byte = 0; byte < 128; ++byte)
        legal += parse_rotation(std::to_string(byte)).ok() ? 1 : 0;
    EXPECT_EQ(legal, 48);
    for (const char* text : {"", "256", "-1", "4.0", "4 4", "0x4"})
        EXPECT_FALSE(parse_rotation(text)) << text;
}

VoxFile read_scene(const std::string& chunks) {
    auto file = read_vox(vox_builder::file(chunks, 200));
    EXPECT_TRUE(file) << (file ? "" : file.reason());
    return file ? file.value() : VoxFile{};
}

std::vector<VoxInstance> instances_of(const std::string& chunks, int frame = 0) {
    const VoxFile file = read_scene(chunks);
    auto instances = vox_instances(file, frame);
    EXPECT_TRUE(instances) << (instances ? "" : instances.reason());
    return instances ? instances.value() : std::vector<VoxInstance>{};
}

// Every pair of nested rotations through the file format, against matrices.
TEST(VoxInstances, nested_rotations_compose_as_matrices) {
    std::vector<std::pair<int, Signed>> bytes;
    for (const Signed& s : all_signed_permutations()) {
        int byte = s.rotation.axis[0] | s.rotation.axis[1] << 2;
        for (int row = 0; row < 3; ++row)
            byte |= s.rotation.sign[static_cast<std::size_t>(row)] < 0 ? 16 << row : 0;
        bytes.emplace_back(byte, s);
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const auto& [outer_byte, outer] = bytes[i];
        const auto& [inner_byte, inner] = bytes[(i * 29 + 11) % bytes.size()];
        const auto instances = instances_of(
            chiral_model(3, 4, 5) +
            transform(0, 1, -1, {{{"_r", std::to_string(outer_byte)}, {"_t", "100 20 3"}}}) + group(1, {2}) +
            transform(2, 3, 0, {{{"_r", std::to_string(inner_byte)}, {"_t", "7 -8 9"}}}) +
            shape(3, {{0, {}}}));
        ASSERT_EQ(instances.size(), 1u);
        const glm::dmat3 both = outer.matrix * inner.matrix;
        const glm::ivec3 t(outer.matrix * glm::dvec3(7, -8, 9) + glm::dvec3(100, 20, 3));
        EXPECT_EQ(instances[0].translation, t);
        const Instance placed{.rotation = instances[0].rotation, .translation = instances[0].translation};
        EXPECT_EQ(world_cell(placed, {3, 4, 5}, {2, 0, 1}), brute_force_cell(both, t, {3, 4, 5}, {2, 0, 1}));
    }
}

TEST(VoxInstances, hiding_comes_from_nodes_groups_and_layers_above) {
    const std::string shapes = shape(10, {{0, {}}});
    const std::string chunks =
        chiral_model(2, 2, 2) + transform(0, 1, -1, {{}}) + group(1, {2, 3, 4, 5, 7}) +
        transform(2, 10, 0, {{}}, {{"_name", "seen"}}) +
        transform(3, 10, 0, {{}}, {{"_name", "hidden node"}, {"_hidden", "1"}}) +
        transform(4, 10, 8, {{}}, {{"_name", "hidden layer"}}) + transform(5, 6, 8, {{}}) + group(6, {9}) +
        transform(9, 10, 0, {{}}, {{"_name", "below it"}}) + transform(7, 8, 0, {{}}) +
        group(8, {11}, {{"_hidden", "1"}}) + transform(11, 10, -5, {{}}, {{"_name", "in a hidden group"}}) +
        shapes + layer(0, {}) + layer(8, {{"_hidden", "1"}});
    const VoxFile file = read_scene(chunks);
    const auto instances = vox_instances(file);
    ASSERT_TRUE(instances);
    std::vector<std::pair<std::string, bool>> found;
    for (const VoxInstance& i : instances.value())
        found.emplace_back(instance_name(file, i), i.hidden);
    EXPECT_EQ(found, (std::vector<std::pair<std::string, bool>>{{"seen", false},
                                                                {"hidden node", true},
                                                                {"hidden layer", true},
                                                                {"below it", true},
                                                                {"in a hidden group", true}}));
    EXPECT_EQ(instances.value()[2].layer, 8);
    EXPECT_EQ(instances.value()[4].layer, -5);
    EXPECT_EQ(scene_from_vox(file).instances.size(), 1u);
}

TEST(VoxInstances, keys_hold_until_the_next_one) {
    const std::vector<std::int64_t> keys = {2, 5, 9};
    const auto at = [&](int frame, bool loop) { return key_at(keys, frame, loop); };
    EXPECT_EQ(at(-100, false), 0u);
    EXPECT_EQ(at(2, false), 0u);
    EXPECT_EQ(at(4, false), 0u);
    EXPECT_EQ(at(5, false), 1u);
    EXPECT_EQ(at(8, false), 1u);
    EXPECT_EQ(at(1000, false), 2u);
    EXPECT_EQ(at(9, true), 2u);
    EXPECT_EQ(at(10, true), 0u);  // the period is 2..9, eight frames
    EXPECT_EQ(at(12, true), 0u);
    EXPECT_EQ(at(13, true), 1u);
    EXPECT_EQ(at(17, true), 2u);
    EXPECT_EQ(key_at({}, 3, true), 0u);
}

TEST(VoxInstances, frames_move_transforms_and_change_models) {
    const std::string chunks =
        chiral_model(2, 2, 2) + chiral_model(3, 3, 3) +
        transform(0, 1, -1, {{{"_f", "0"}, {"_t", "1 0 0"}}, {{"_f", "4"}, {"_t", "2 0 0"}}}) +
        shape(1, {{0, {{"_f", "0"}}}, {1, {{"_f", "3"}}}}, {{"_loop", "1"}});
    const int model[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (int frame = 0; frame < 9; ++frame) {
        const auto instances = instances_of(chunks, frame);
        ASSERT_EQ(instances.size(), 1u);
        EXPECT_EQ(instances[0].translation.x, frame < 4 ? 1 : 2) << frame;
        EXPECT_EQ(instances[0].model, static_cast<std::uint32_t>(model[frame])) << frame;
    }
}

TEST(VoxInstances, pack_shows_one_model_per_frame) {
    const std::string chunks =
        chunk("PACK", i32(3)) + chiral_model(2, 2, 2) + chiral_model(3, 3, 3) + chiral_model(5, 5, 5);
    for (const auto& [frame, model] : {std::pair{0, 0u}, {1, 1u}, {2, 2u}, {3, 0u}, {-1, 2u}}) {
        const auto instances = instances_of(chunks, frame);
        ASSERT_EQ(instances.size(), 1u);
        EXPECT_EQ(instances[0].model, model) << frame;
    }
}

TEST(VoxInstances, without_a_graph_models_stand_at_the_origin) {
    for (const glm::ivec3 size : {glm::ivec3(3, 4, 5), glm::ivec3(4, 3, 2)}) {
        const auto instances = instances_of(chiral_model(size.x, size.y, size.z));
        ASSERT_EQ(instances.size(), 1u);
        const Instance placed{.rotation = instances[0].rotation, .translation = instances[0].translation};
        EXPECT_EQ(world_cell(placed, size, {1, 2, 0}), glm::ivec3(1, 2, 0));
    }
}

TEST(VoxInstances, a_hand_made_cycle_is_refused) {
    VoxFile file;
    file.nodes = {VoxTransform{.id = 0, .child = 1, .frames = {{}}}, VoxGroup{.id = 1, .children = {0}}};
    const auto instances = vox_instances(file);
    ASSERT_FALSE(instances);
    EXPECT_EQ(instances.reason(), "node 0: node 0 is below itself: the scene graph has a cycle");
}

// A file placed in a scene by an outer placement: its cells, moved one by one, are those of the instances.
TEST(VoxPlacement, outer_placement_moves_every_cell_exactly) {
    const VoxFile file =
        read_scene(chiral_model(3, 4, 5) + transform(0, 1, -1, {{{"_r", "40"}, {"_t", "5 6 -7"}}}) +
                   shape(1, {{0, {}}}));
    const Scene plain = scene_from_vox(file);
    for (const Signed& s : all_signed_permutations()) {
        Scene scene;
        const glm::ivec3 t{-30, 17, 4};
        append_vox(scene, file, 0, s.rotation, t);
        ASSERT_EQ(scene.instances.size(), 1u);
        for (const Voxel& voxel : scene.models[0].voxels) {
            const glm::ivec3 v{voxel.x, voxel.y, voxel.z};
            const glm::ivec3 cell = world_cell(plain.instances[0], {3, 4, 5}, v);
            const glm::ivec3 expected = glm::ivec3(glm::floor(s.matrix * (glm::dvec3(cell) + 0.5))) + t;
            EXPECT_EQ(world_cell(scene.instances[0], {3, 4, 5}, v), expected);
        }
    }
}

TEST(VoxPlacement, beyond_the_limit_is_refused) {
    const VoxFile file = read_scene(chiral_model(2, 2, 2));
    Scene scene;
    EXPECT_THROW(append_vox(scene, file, 0, Rotation{}, {static_cast<int>(kVoxMaxTranslation), 0, 0}), Error);
}

}  // namespace
}  // namespace voxilux
