#include "renderer/editable_voxels.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "support/edited_scene.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

Scene slab() {
    Scene scene = test::white_scene();
    scene.materials.resize(3);
    test::add_box(scene, {-8, -8, -1}, {8, 8, 0});
    test::add_box(scene, {0, 0, 0}, {1, 1, 40}, 1);
    return scene;
}

// Everything that the voxels of a scene determine.
void expect_equal(const EditableVoxels& a, const EditableVoxels& b) {
    EXPECT_EQ(a.world().origin(), b.world().origin());
    EXPECT_EQ(a.world().chunks(), b.world().chunks());
    const VoxelFacts facts = a.facts(), wanted = b.facts();
    EXPECT_EQ(facts.count, wanted.count);
    EXPECT_EQ(facts.box, wanted.box);
    EXPECT_EQ(facts.used, wanted.used);
    b.world().for_each_voxel(
        [&](glm::ivec3 cell, std::uint16_t voxel) { ASSERT_EQ(a.world().get(cell), voxel); });
}

TEST(EditableVoxels, edits_give_the_voxels_of_the_edited_scene) {
    const Scene scene = slab();
    EditableVoxels voxels(scene);
    std::vector<BoxEdit> edits;
    for (const BoxEdit& edit : {BoxEdit{.box = {{2, 2, 0}, {4, 4, 3}}, .material = 2},
                                BoxEdit{.box = {{0, 0, 20}, {1, 1, 40}}},  // the box shrinks
                                BoxEdit{.box = {{0, 0, 0}, {1, 1, 20}}},   // a material is used no more
                                BoxEdit{.box = {{5, 5, 5}, {5, 6, 6}}, .material = 1},  // an empty box
                                BoxEdit{.box = {{-9, 0, 0}, {-8, 1, 1}}, .material = 0},
                                BoxEdit{.box = {{-99, -99, -99}, {99, 99, 99}}},
                                BoxEdit{.box = {{70, 70, 70}, {72, 71, 71}}, .material = 1}}) {
        edits.push_back(edit);
        (void)voxels.apply(std::span(&edit, 1));
        expect_equal(voxels, EditableVoxels(test::edited_scene(scene, edits)));
    }
}

TEST(EditableVoxels, change_names_the_cells_that_are_others_now) {
    EditableVoxels voxels(slab());
    const std::vector<BoxEdit> edits = {{.box = {{0, 0, 0}, {1, 2, 1}}, .material = 1}};  // one is there
    const VoxelChange change = voxels.apply(edits);
    EXPECT_FALSE(change.has_moved);
    ASSERT_EQ(change.cells.size(), 1u);
    EXPECT_EQ(change.cells[0].local + voxels.world().origin(), glm::ivec3(0, 1, 0));
    EXPECT_TRUE(voxels.apply(edits).cells.empty());
    const BoxEdit beyond{.box = {{-20, 0, 0}, {-19, 1, 1}}, .material = 1};
    EXPECT_TRUE(voxels.apply(std::span(&beyond, 1)).has_moved);
}

TEST(EditableVoxels, refused_edit_changes_nothing) {
    const Scene scene = slab();
    EditableVoxels voxels(scene);
    const BoxEdit good{.box = {{2, 2, 2}, {3, 3, 3}}, .material = 1};
    for (const BoxEdit& bad :
         {BoxEdit{.box = {{0, 0, 0}, {1, 1, 1}}, .material = 3},
          BoxEdit{.box = {{0, 0, 0}, {1, 1, kMaxCoordinate + 1}}},
          BoxEdit{.box = {{1 << 28, 1 << 28, 1 << 28}, {(1 << 28) + 1, (1 << 28) + 1, (1 << 28) + 1}},
          .material = 1}}) {
        const std::vector<BoxEdit> edits = {good, bad};
        EXPECT_THROW(voxels.apply(edits), Error);
        expect_equal(voxels, EditableVoxels(scene));
    }
}

}  // namespace
}  // namespace voxilux
