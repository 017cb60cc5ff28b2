#include "world/vox_edits.h"

#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "formats/vox_read.h"
#include "formats/vox_write.h"
#include "scene/vox_instances.h"
#include "scene/vox_scene.h"

namespace voxilux {
namespace {

// A file of two models that overlap, one of them turned, with chunks that no edit may touch.
VoxFile two_models() {
    VoxFile file;
    file.has_palette = true;
    file.models = {{.size = {8, 6, 5}}, {.size = {4, 9, 3}}};
    std::mt19937 random(5);
    for (VoxModel& model : file.models)
        for (int i = 0; i < 60; ++i)
            model.voxels.push_back({static_cast<std::uint8_t>(random() % static_cast<unsigned>(model.size.x)),
                                    static_cast<std::uint8_t>(random() % static_cast<unsigned>(model.size.y)),
                                    static_cast<std::uint8_t>(random() % static_cast<unsigned>(model.size.z)),
                                    static_cast<std::uint8_t>(1 + random() % 4)});
    file.nodes = {VoxTransform{.id = 0, .child = 1, .frames = {{}}},
                  VoxGroup{.id = 1, .children = {2, 4}},
                  VoxTransform{.id = 2, .child = 3, .frames = {{{"_t", "1 2 3"}}}},
                  VoxShape{.id = 3, .models = {{0, {}}}},
                  VoxTransform{.id = 4, .child = 5, .frames = {{{"_r", "17"}, {"_t", "3 0 5"}}}},
                  VoxShape{.id = 5, .models = {{1, {}}}}};
    file.layers = {{.id = 0, .attributes = {{"_name", "ground"}}}};
    file.cameras = {{.id = 0, .attributes = {{"_mode", "pers"}}}};
    file.unknown = {{.id = {'A', 'B', 'C', 'D'}, .content = {std::byte{7}}}};
    const auto read = read_vox(write_vox(file));
    EXPECT_TRUE(read) << read.reason();
    return read.value();
}

using Voxels = std::map<std::array<int, 3>, std::uint32_t>;

Voxels voxels_of(const VoxelWorld& world, const std::vector<Material>& materials) {
    Voxels voxels;
    world.for_each_voxel([&](glm::ivec3 local, std::uint16_t voxel) {
        const glm::ivec3 cell = local + world.origin();
        const glm::vec3 albedo = materials.at(voxel & 0x7FFFu).albedo;
        voxels[{cell.x, cell.y, cell.z}] = static_cast<std::uint32_t>(255.0f * albedo.x) << 16 |
                                           static_cast<std::uint32_t>(255.0f * albedo.y) << 8 |
                                           static_cast<std::uint32_t>(255.0f * albedo.z);
    });
    return voxels;
}

// The world of the file with cells set and cleared at random, some far outside its models.
VoxelWorld edited_world(const Scene& scene) {
    const VoxelWorld before = build_world(scene);
    VoxelWorld world(glm::ivec3(-320), glm::ivec3(40));
    before.for_each_voxel([&](glm::ivec3 local, std::uint16_t voxel) {
        world.put(local + before.origin() - world.origin(), voxel);
    });
    std::mt19937 random(11);
    for (int i = 0; i < 400; ++i) {
        const int reach = i % 8 == 0 ? 300 : 8;
        const auto any = [&] {
            return static_cast<int>(random() % static_cast<unsigned>(2 * reach)) - reach;
        };
        const glm::ivec3 local = glm::ivec3(any(), any(), any()) - world.origin();
        world.put(local, i % 3 == 0
                             ? VoxelWorld::kEmpty
                             : static_cast<std::uint16_t>(0x8000u | random() % scene.materials.size()));
    }
    return world;
}

TEST(VoxEdits, file_shows_what_the_world_holds) {
    const VoxFile file = two_models();
    const Scene scene = scene_from_vox(file);
    const VoxelWorld world = edited_world(scene);
    const auto saved = read_vox(write_vox(with_voxels(file, world, scene.materials)));
    ASSERT_TRUE(saved) << saved.reason();
    const Scene again = scene_from_vox(saved.value());
    EXPECT_EQ(voxels_of(build_world(again), again.materials), voxels_of(world, scene.materials));
    EXPECT_NE(voxels_of(world, scene.materials), voxels_of(build_world(scene), scene.materials));
    EXPECT_EQ(saved.value().layers, file.layers);
    EXPECT_EQ(saved.value().cameras, file.cameras);
    EXPECT_EQ(saved.value().unknown, file.unknown);
    EXPECT_EQ(saved.value().palette, file.palette);
}

TEST(VoxEdits, file_without_a_graph_gets_one_where_a_voxel_lies_outside) {
    VoxFile file = two_models();
    file.nodes.clear();
    const Scene scene = scene_from_vox(file);
    const VoxelWorld world = edited_world(scene);
    const VoxFile saved = with_voxels(file, world, scene.materials);
    const Scene again = scene_from_vox(saved);
    EXPECT_EQ(voxels_of(build_world(again), again.materials), voxels_of(world, scene.materials));
}

TEST(VoxEdits, same_voxels_give_the_same_file) {
    const VoxFile file = two_models();
    const Scene scene = scene_from_vox(file);
    EXPECT_EQ(write_vox(with_voxels(file, build_world(scene), scene.materials)), write_vox(file));
}

TEST(VoxEdits, model_shown_twice_is_refused_when_it_would_change) {
    VoxFile file = two_models();
    std::get<VoxShape>(file.nodes[5]).models[0].model = 0;
    const Scene scene = scene_from_vox(file);
    EXPECT_NO_THROW((void)with_voxels(file, build_world(scene), scene.materials));
    EXPECT_THROW((void)with_voxels(file, edited_world(scene), scene.materials), Error);
}

TEST(VoxEdits, files_in_which_edits_have_no_place_are_refused) {
    const VoxFile file = two_models();
    const Scene scene = scene_from_vox(file);
    VoxFile pack = file;
    pack.pack = 2;
    pack.nodes.clear();
    EXPECT_THROW((void)with_voxels(pack, build_world(scene), scene.materials), Error) << "models are frames";
    VoxFile turned = file;
    std::get<VoxTransform>(turned.nodes[0]).frames = {{{"_t", "0 0 9"}}};
    EXPECT_THROW((void)with_voxels(turned, edited_world(scene), scene.materials), Error);
    std::get<VoxTransform>(turned.nodes[0]).frames = {{{"_t", "0 0 0"}, {"_r", "4"}}};
    EXPECT_NO_THROW((void)with_voxels(turned, edited_world(scene), scene.materials)) << "moves nothing";
}

}  // namespace
}  // namespace voxilux
