#include "renderer/edit_history.h"

#include <gtest/gtest.h>

#include <random>

#include "support/light_scenes.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

Box random_box(std::mt19937& random) {
    std::uniform_int_distribution<int> place(-20, 20), edge(1, 7);
    const glm::ivec3 lo{place(random), place(random), place(random)};
    return {lo, lo + glm::ivec3(edge(random), edge(random), edge(random))};
}

std::map<std::array<int, 3>, std::uint16_t> cells_of(const VoxelWorld& world) {
    std::map<std::array<int, 3>, std::uint16_t> cells;
    world.for_each_voxel([&](glm::ivec3 local, std::uint16_t voxel) {
        const glm::ivec3 cell = local + world.origin();
        cells[{cell.x, cell.y, cell.z}] = voxel;
    });
    return cells;
}

Scene two_materials() {
    Scene scene = test::white_scene();
    test::add_diffuse(scene, 0.5f);
    test::add_box(scene, {-8, -8, -1}, {8, 8, 3});
    return scene;
}

// Places, paints and clears, several boxes at once.
std::vector<BoxEdit> random_edits(std::mt19937& random) {
    std::uniform_int_distribution<std::uint32_t> kind(0, 3), material(0, 1);
    std::vector<BoxEdit> edits(1 + kind(random));
    for (BoxEdit& edit : edits) {
        edit.box = random_box(random);
        if (kind(random) > 0) edit.material = material(random);
        edit.paints = edit.material && kind(random) == 0;
    }
    return edits;
}

TEST(EditHistory, undo_of_all_edits_gives_the_first_voxels_and_redo_the_last) {
    std::mt19937 random(3);
    EditableVoxels voxels(two_materials());
    EditHistory history;
    std::vector<std::map<std::array<int, 3>, std::uint16_t>> states{cells_of(voxels.world())};
    for (int i = 0; i < 200; ++i) {
        const std::vector<BoxEdit> edits = random_edits(random);
        history.add(edits, voxels.apply(edits).back);
        states.push_back(cells_of(voxels.world()));
    }
    for (std::size_t i = states.size() - 1; i-- > 0;) {
        (void)voxels.apply(*history.undo());
        ASSERT_EQ(cells_of(voxels.world()), states[i]) << i;
    }
    EXPECT_EQ(history.undo(), nullptr);
    while (const std::vector<BoxEdit>* const made = history.redo())
        (void)voxels.apply(*made);
    EXPECT_EQ(cells_of(voxels.world()), states.back());
    EXPECT_NE(states.front(), states.back());
}

TEST(EditHistory, paint_changes_no_air) {
    EditableVoxels voxels(two_materials());
    const std::uint64_t count = voxels.world().voxel_count();
    const BoxEdit paint{{{-20, -20, -20}, {20, 20, 20}}, 1u, true};
    EXPECT_EQ(voxels.apply({&paint, 1}).cells.size(), count);
    EXPECT_EQ(voxels.world().voxel_count(), count);
}

TEST(EditHistory, new_edit_forgets_what_was_taken_back) {
    const BoxEdit edit{{{0, 0, 0}, {1, 1, 1}}, 0u};
    EditHistory history;
    history.add({edit}, {edit});
    history.add({edit}, {edit});
    ASSERT_NE(history.undo(), nullptr);
    history.add({edit}, {edit});
    EXPECT_EQ(history.redo(), nullptr);
    EXPECT_EQ(history.undo_count(), 2u);
}

TEST(EditHistory, memory_stays_below_its_bound) {
    EditHistory history(10000);
    const BoxEdit edit{{{0, 0, 0}, {1, 1, 1}}, 0u};
    for (int i = 0; i < 1000; ++i) {
        history.add({edit}, {edit, edit, edit});
        ASSERT_LE(history.bytes(), 10000u);
    }
    EXPECT_GT(history.undo_count(), 10u);
    EXPECT_LT(history.undo_count(), 1000u);
}

}  // namespace
}  // namespace voxilux
