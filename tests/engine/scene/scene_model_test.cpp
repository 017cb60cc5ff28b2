#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <tuple>

#include "base/error.h"
#include "base/file.h"
#include "formats/scene_toml.h"
#include "formats/vox_write.h"
#include "scene/scene_camera.h"
#include "scene/scene_hash.h"
#include "scene/vox_scene.h"
#include "support/scene_voxels.h"
#include "support/scratch_folder.h"

namespace voxilux {
namespace {

using NamedCells = std::map<std::tuple<int, int, int>, std::string>;  // cell to material name

NamedCells named_cells_of(const Scene& scene) {
    NamedCells cells;
    test::for_each_scene_voxel(scene, [&](glm::ivec3 c, std::uint16_t material) {
        cells[{c.x, c.y, c.z}] = scene.materials.at(material).name;
    });
    return cells;
}

// A lopsided model of odd and even sides.
VoxFile small_file() {
    VoxFile file;
    file.models.push_back({.size = {3, 4, 5},
                           .voxels = {{0, 0, 0, 1}, {2, 0, 0, 2}, {0, 3, 0, 3}, {0, 0, 4, 4}, {1, 2, 3, 5}}});
    return file;
}

class SceneModel : public testing::Test {
  protected:
    SceneModel() { write_file_atomically(folder_ / "m.vox", write_vox(small_file())); }

    [[nodiscard]] Scene load(const std::string& keys) const {
        return parse_scene("[[model]]\nfile = \"m.vox\"\n" + keys, folder_ / "s.toml");
    }

    // The middles of the untouched model's cells moved by `move`.
    [[nodiscard]] NamedCells moved(const std::function<glm::dvec3(glm::dvec3)>& move) const {
        NamedCells cells;
        for (const auto& [cell, material] : named_cells_of(scene_from_vox(small_file()))) {
            const auto [x, y, z] = cell;
            const glm::dvec3 p = glm::floor(move(glm::dvec3(x, y, z) + 0.5));
            cells[{static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)}] = material;
        }
        return cells;
    }

    ScratchFolder folder_;
};

TEST_F(SceneModel, rotations_are_right_handed_quarter_turns) {
    using V = glm::dvec3;
    EXPECT_EQ(named_cells_of(load("")), moved([](V p) { return p; }));
    EXPECT_EQ(named_cells_of(load("rotate = \"x90\"")), moved([](V p) { return V(p.x, -p.z, p.y); }));
    EXPECT_EQ(named_cells_of(load("rotate = \"y90\"")), moved([](V p) { return V(p.z, p.y, -p.x); }));
    EXPECT_EQ(named_cells_of(load("rotate = \"z90\"")), moved([](V p) { return V(-p.y, p.x, p.z); }));
    EXPECT_EQ(named_cells_of(load("rotate = \"z180\"")), moved([](V p) { return V(-p.x, -p.y, p.z); }));
    EXPECT_EQ(named_cells_of(load("rotate = \"z270\"")), moved([](V p) { return V(p.y, -p.x, p.z); }));
    EXPECT_NE(named_cells_of(load("rotate = \"z270\"")), moved([](V p) { return V(-p.y, p.x, p.z); }));
}

TEST_F(SceneModel, rotations_then_mirrors_then_translation) {
    const NamedCells cells = named_cells_of(
        load("rotate = [\"x90\", \"z90\"]\nmirror = [\"x\", \"z\"]\ntranslate = [10, -20, 30]"));
    EXPECT_EQ(cells, moved([](glm::dvec3 p) {
                  const glm::dvec3 x90(p.x, -p.z, p.y);
                  const glm::dvec3 z90(-x90.y, x90.x, x90.z);
                  return glm::dvec3(-z90.x, z90.y, -z90.z) + glm::dvec3(10, -20, 30);
              }));
}

TEST_F(SceneModel, model_placed_twice_is_kept_once) {
    const Scene scene = load("[[model]]\nfile = \"m.vox\"\ntranslate = [50, 0, 0]\n");
    EXPECT_EQ(scene.models.size(), 1u);
    EXPECT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(named_cells_of(scene).size(), 10u);
}

TEST_F(SceneModel, models_shapes_and_materials_stand_side_by_side) {
    const Scene scene =
        load("[material.a]\n[[shape]]\nshape = \"box\"\nfrom = [40,0,0]\nto = [42,1,1]\nmaterial = \"a\"\n");
    const NamedCells cells = named_cells_of(scene);
    EXPECT_EQ(cells.size(), 7u);
    EXPECT_EQ(cells.at({41, 0, 0}), "a");
}

TEST_F(SceneModel, broken_file_is_refused_at_its_line) {
    write_file_atomically(folder_ / "m.vox", std::vector<std::byte>(7));
    try {
        (void)load("");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        EXPECT_NE(std::string(error.what()).find("s.toml:2:8: 'file' in [[model]] cannot be used: "),
                  std::string::npos)
            << error.what();
    }
}

TEST_F(SceneModel, vox_input_takes_overrides) {
    const Scene plain = load_scene(folder_ / "m.vox");
    EXPECT_EQ(scene_hash(plain), scene_hash(scene_from_vox(small_file())));
    const Scene low =
        load_scene(folder_ / "m.vox", {.overrides = {"sun.elevation=10", "camera.preset=front"}});
    EXPECT_EQ(low.sun.elevation_deg, 10.0f);
    EXPECT_EQ(low.camera.value().yaw_deg, 90.0);
    EXPECT_EQ(named_cells_of(low), named_cells_of(plain));
    EXPECT_THROW((void)load_scene(folder_ / "m.vox", {.overrides = {"sun.elevaton=10"}}), Error);
}

TEST_F(SceneModel, field_of_view_alone_keeps_the_default_view) {
    const Scene wide = load_scene(folder_ / "m.vox", {.overrides = {"camera.fov=70"}});
    EXPECT_EQ(wide.camera.value().fov_y_deg, 70.0);
    EXPECT_EQ(wide.camera.value().yaw_deg, camera_of(load_scene(folder_ / "m.vox")).yaw_deg);
}

}  // namespace
}  // namespace voxilux
