// What emits in a mesh file emits in the .vox file: the radiance of the file against that which the reader of
// .vox files gets, through the whole of voxelize.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <set>

#include "formats/vox_read.h"
#include "scene/vox_material.h"
#include "support/gltf_builder.h"
#include "support/scratch_folder.h"
#include "voxelizer/load_mesh.h"
#include "voxelizer/surface_look.h"
#include "voxelizer/vox_output.h"

namespace voxilux {
namespace {

using gltf_builder::File;
using gltf_builder::json;

constexpr float kTolerance = 0.03f;

// The materials of all voxels in the .vox file that a mesh becomes.
std::vector<Material> voxelized(const Mesh& mesh, int resolution = 4) {
    const ScratchFolder folder;
    const VoxelSet set = voxelize_mesh(mesh, {.grid = {.resolution = resolution}, .threads = 1});
    const VoxelPalette palette(set, false);
    write_voxels(folder / "a.vox", set, palette, mesh, "a");
    const VoxFile file = load_vox(folder / "a.vox");
    std::vector<std::string> warnings;
    const auto materials = vox_materials(file, warnings);
    EXPECT_TRUE(warnings.empty()) << warnings.front();
    std::vector<Material> used;
    for (const VoxModel& model : file.models) {
        for (const VoxVoxel& voxel : model.voxels)
            used.push_back(materials[voxel.index]);
    }
    return used;
}

Mesh loaded_emission(const std::string& name, const std::string& text, const std::string& library = "") {
    const ScratchFolder folder;
    std::ofstream(folder / name, std::ios::binary) << text;
    std::ofstream(folder / "a.mtl", std::ios::binary) << library;
    return load_mesh(folder / name);
}

Mesh square_with(const json& material) {
    File file = gltf_builder::textured_square();
    file.root["materials"][0] = material;
    return loaded_emission("a.gltf", file.gltf());
}

Mesh obj_with(const std::string& fields) {
    return loaded_emission("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl m\nf 1 2 3 4\n",
                           "newmtl m\n" + fields);
}

// Channels below a sixteenth of the brightest are a few steps of a byte: their bound is relative to the
// brightest.
bool is_radiance(glm::vec3 have, glm::vec3 wanted) {
    const float brightest = std::max({wanted.r, wanted.g, wanted.b});
    for (int i = 0; i < 3; ++i) {
        if (!(std::abs(have[i] - wanted[i]) <= kTolerance * std::max(wanted[i], brightest / 16.0f)))
            return false;
    }
    return true;
}

void expect_radiance(const Mesh& mesh, glm::vec3 wanted) {
    EXPECT_TRUE(mesh.warnings.empty()) << mesh.warnings.front();
    const std::vector<Material> materials = voxelized(mesh);
    EXPECT_GE(materials.size(), 16u);
    for (const Material& material : materials) {
        EXPECT_EQ(material.surface, Surface::emit);
        EXPECT_TRUE(is_radiance(material.emission, wanted))
            << material.emission.r << " " << material.emission.g << " " << material.emission.b << ", not "
            << wanted.r << " " << wanted.g << " " << wanted.b;
    }
}

TEST(Emission, checker_sees_four_percent) {
    EXPECT_TRUE(is_radiance({1, 0.5, 0}, {1, 0.5, 0}));
    EXPECT_FALSE(is_radiance({1.04f, 0.5f, 0}, {1, 0.5, 0}));
    EXPECT_FALSE(is_radiance({1, 0.48f, 0}, {1, 0.5, 0}));
    EXPECT_FALSE(is_radiance({1, 0.5f, 0.01f}, {1, 0.5, 0}));
    EXPECT_FALSE(is_radiance({NAN, 0.5f, 0}, {1, 0.5, 0}));
}

TEST(Emission, black_body_emits_in_the_colour_of_its_emission) {
    expect_radiance(obj_with("Kd 0 0 0\nKe 0 1 0\n"), {0, 1, 0});
    expect_radiance(
        square_with({{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}},
                     {"emissiveFactor", {0.1, 0.5, 0.9}},
                     {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}}),
        {0.4f, 2.0f, 3.6f});
}

TEST(Emission, strengths_reach_as_far_as_the_reader_of_vox_files) {
    for (const double strength : {1.0 / 4096, 0.01, 0.7, 1.0, 11.0, 16.0, 17.0, 1e3, 1e6, 6.5e7}) {
        expect_radiance(
            square_with(
                {{"emissiveFactor", {1, 1, 1}},
                 {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", strength}}}}}}),
            glm::vec3(static_cast<float>(strength)));
    }
}

TEST(Emission, any_colour_on_any_base_colour_is_within_three_percent) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 radiance =
            glm::vec3(unit(random), unit(random), unit(random)) * std::exp2(30.0f * unit(random) - 8.0f);
        const float base = unit(random) * unit(random);
        expect_radiance(obj_with(fmt::format("Kd {} {} 0\nKe {} {} {}\n", base, unit(random), radiance.r,
                                             radiance.g, radiance.b)),
                        radiance);
    }
}

TEST(Emission, outside_the_range_is_noted) {
    const auto warnings = [](const std::string& fields) { return obj_with(fields).warnings; };
    EXPECT_EQ(warnings("Ke 1e9 0 0\n"), std::vector<std::string>{"an emission above 65536000 is cut there"});
    EXPECT_EQ(warnings("Ke 0.0001 0 0\n"), std::vector<std::string>{"an emission below 1/4096 is left out"});
    EXPECT_EQ(warnings("Ke -1 0 0\n"), std::vector<std::string>{"an emission below 0 is read as 0"});
    EXPECT_EQ(warnings("Ke nan 0 0\n"),
              std::vector<std::string>{"an emission that is not a number is read as 0"});
    EXPECT_TRUE(warnings("Ke 1 0 0\n").empty());
}

// Texels red, green, blue and white, magnified without interpolation.
TEST(Emission, texture_of_emission_keeps_its_colours_at_their_strength) {
    File file = gltf_builder::textured_square();
    file.root["samplers"] = {{{"magFilter", 9728}}};
    file.root["textures"][0]["sampler"] = 0;
    file.root["materials"][0] = {
        {"emissiveFactor", {1, 0.5, 1}},
        {"emissiveTexture", {{"index", 0}}},
        {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 20}}}}}};
    std::size_t seen[4] = {};
    for (const Material& material : voxelized(loaded_emission("a.gltf", file.gltf()), 32)) {
        const glm::vec3 colours[4] = {{20, 0, 0}, {0, 10, 0}, {0, 0, 20}, {20, 10, 20}};
        for (std::size_t i = 0; i < 4; ++i)
            seen[i] += is_radiance(material.emission, colours[i]) ? 1 : 0;
    }
    for (const std::size_t count : seen)
        EXPECT_GE(count, 15u * 15);
}

// Two squares of 4 x 4 cells side by side; where they meet, a cell is wholly of one of them.
TEST(Emission, colours_of_emitters_and_of_others_do_not_mix) {
    Mesh mesh = loaded_emission("a.obj",
                                "mtllib a.mtl\nv 0 0 0\nv 3.3 0 0\nv 3.3 4 0\nv 0 4 0\nv 8 0 0\nv 8 4 0\n"
                                "usemtl lamp\nf 1 2 3 4\nusemtl wall\nf 2 5 6 3\n",
                                "newmtl lamp\nKd 0 0 0\nKe 0 9 0\nnewmtl wall\nKd 1 0 0\n");
    std::size_t emitters = 0, walls = 0;
    for (const Material& material : voxelized(mesh, 8)) {
        const bool is_emitter =
            material.surface == Surface::emit && is_radiance(material.emission, {0, 9, 0});
        const bool is_wall = material.surface == Surface::diffuse && material.albedo == glm::vec3(1, 0, 0);
        EXPECT_NE(is_emitter, is_wall);
        (is_emitter ? emitters : walls) += 1;
    }
    EXPECT_EQ(emitters, 12u) << "three columns, and of the fourth 0.3 only";
    EXPECT_EQ(walls, 20u);
}

TEST(Emission, few_emitters_keep_their_colours_beside_thousands_of_others) {
    VoxelSet set;
    set.blocks.emplace_back();
    std::mt19937 random(1);
    std::uniform_int_distribution<int> byte(0, 255);
    const auto add = [&](int r, int g, int b, const Look& look) {
        set.blocks[0].surface.push_back({.r = static_cast<std::uint8_t>(r),
                                         .g = static_cast<std::uint8_t>(g),
                                         .b = static_cast<std::uint8_t>(b),
                                         .look = packed(look)});
    };
    const Look emitter{.kind = LookKind::emit, .level = 15};
    for (int i = 0; i < 20000; ++i)
        add(byte(random), byte(random), byte(random), {});
    for (int i = 0; i < 60; ++i)
        add(i % 3 == 0 ? 255 : 0, i % 3 == 1 ? 255 : 0, i % 3 == 2 ? 255 : 0, emitter);
    set.surface = set.blocks[0].surface.size();
    EXPECT_EQ(VoxelPalette(set, false).error().radiances_off, 0u);
    for (int i = 0; i < 4000; ++i)
        add(byte(random), byte(random), byte(random), emitter);
    set.surface = set.blocks[0].surface.size();
    EXPECT_GT(VoxelPalette(set, false).error().radiances_off, 1000u) << "what does not fit is counted";
}

}  // namespace
}  // namespace voxilux
