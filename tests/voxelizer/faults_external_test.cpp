// Inputs of the shared data with features that voxels cannot show: each must report what is lost.

#include <gtest/gtest.h>

#include <map>

#include "base/error.h"
#include "formats/vox_read.h"
#include "scene/vox_material.h"
#include "support/scratch_folder.h"
#include "support/shared_data.h"
#include "voxelizer/load_mesh.h"
#include "voxelizer/vox_output.h"

namespace voxilux {
namespace {

struct Outcome {
    std::size_t voxels = 0;
    Material material;  // of the first voxel
    std::vector<std::string> warnings;
};

Outcome voxelized_fault(const std::string& name, const VoxelizeRequest& request) {
    const Mesh mesh = load_mesh(shared_data() / "data/faults" / name);
    const VoxelSet set = voxelize_mesh(mesh, request);
    const ScratchFolder folder;
    write_voxels(folder / "a.vox", set, VoxelPalette(set, false), mesh, "a");
    const VoxFile file = load_vox(folder / "a.vox");
    std::vector<std::string> ignored;
    const auto materials = vox_materials(file, ignored);
    return {.voxels = set.surface + set.interior,
            .material = materials[file.models.at(0).voxels.at(0).index],
            .warnings = mesh.warnings};
}

Outcome at_64(const std::string& name) {
    return voxelized_fault(name, {.grid = {.resolution = 64}});
}

void expect_near(glm::vec3 have, glm::vec3 wanted) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(have[i], wanted[i], 0.03f * wanted[i]);
}

TEST(FaultsExternal, emission_is_what_the_files_say) {
    SKIP_WITHOUT_SHARED_DATA();
    expect_near(at_64("kb_kg.obj").material.emission, {0, 1, 0});
    expect_near(at_64("g_emit_black.gltf").material.emission, {0.4f, 2.0f, 3.6f});
    expect_near(at_64("g_strength16.gltf").material.emission, {16, 16, 16});
}

// Five squares of 8 x 8 cells, 16 apart. All but the last touch a column of cells behind their right edge.
TEST(FaultsExternal, five_instances_are_five_squares) {
    SKIP_WITHOUT_SHARED_DATA();
    VoxelizeRequest request{.grid = {.resolution = 72}, .coverage = Coverage::thin};
    EXPECT_EQ(voxelized_fault("g_instancing.gltf", request).voxels, 5u * 8 * 8);
    request.coverage = Coverage::conservative;
    EXPECT_EQ(voxelized_fault("g_instancing.gltf", request).voxels, 4u * 9 * 8 + 8u * 8);
    EXPECT_TRUE(at_64("g_instancing.gltf").warnings.empty());
}

TEST(FaultsExternal, unlit_is_diffuse_and_illumination_9_is_glass) {
    SKIP_WITHOUT_SHARED_DATA();
    const Outcome unlit = at_64("g_unlit.gltf");
    EXPECT_EQ(unlit.material.surface, Surface::diffuse);
    EXPECT_EQ(unlit.warnings.size(), 1u);
    const Outcome glass = at_64("pbr_illum.obj");
    EXPECT_EQ(glass.material.surface, Surface::glass);
    EXPECT_EQ(glass.material.transmission, 1.0f);
    EXPECT_EQ(glass.material.ior, 1.5f);
    expect_near(glass.material.albedo, {0.9f, 0.9f, 1.0f});
}

TEST(FaultsExternal, overlapping_cubes_are_solid_but_by_parity) {
    SKIP_WITHOUT_SHARED_DATA();
    VoxelizeRequest request{.grid = {.metres_per_voxel = 1.0}, .is_solid = true};
    EXPECT_EQ(voxelized_fault("cube4.obj", request).voxels, 64u);
    EXPECT_EQ(voxelized_fault("cube4_two.obj", request).voxels, 96u);
    request.inside = InsideRule::parity;
    EXPECT_EQ(voxelized_fault("cube4_two.obj", request).voxels, 92u);
}

}  // namespace
}  // namespace voxilux
