#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "formats/vox_info.h"
#include "formats/vox_read.h"
#include "scene/vox_material.h"
#include "scene/vox_scene.h"
#include "support/vox_builder.h"

namespace voxilux {
namespace {

using namespace vox_builder;

VoxFile read_good(const std::string& chunks) {
    auto file = read_vox(vox_builder::file(chunks));
    EXPECT_TRUE(file) << (file ? "" : file.reason());
    return file ? file.value() : VoxFile{};
}

// Material 1 of a file whose colour 1 is white.
Material material_of(const Pairs& properties, std::vector<std::string>* warnings = nullptr) {
    const VoxFile file = read_good(chiral_model(2, 2, 2) + record("MATL", 1, properties));
    std::vector<std::string> found;
    const Material material = vox_materials(file, found)[1];
    if (warnings != nullptr) *warnings = found;
    return material;
}

TEST(VoxMaterial, types_and_properties_are_mapped) {
    EXPECT_EQ(material_of({{"_rough", "0.1"}}).surface, Surface::diffuse);
    const Material metal = material_of(
        {{"_type", "_metal"}, {"_metal", "0.75"}, {"_rough", "0.25"}, {"_ri", "1.4"}, {"_ior", "0.3"}});
    EXPECT_EQ(metal.surface, Surface::metal);
    EXPECT_FLOAT_EQ(metal.metallic, 0.75f);
    EXPECT_FLOAT_EQ(metal.roughness, 0.25f);
    EXPECT_FLOAT_EQ(metal.ior, 1.4f);
    const Material glass = material_of({{"_type", "_glass"}, {"_alpha", "0.5"}, {"_ior", "0.3"}});
    EXPECT_EQ(glass.surface, Surface::glass);
    EXPECT_FLOAT_EQ(glass.transmission, 0.5f);
    EXPECT_FLOAT_EQ(glass.ior, 1.3f);
    const Material blend = material_of({{"_type", "_blend"}, {"_metal", "0.1"}, {"_trans", "0.2"}});
    EXPECT_EQ(blend.surface, Surface::blend);
    EXPECT_FLOAT_EQ(blend.metallic, 0.1f);
    EXPECT_FLOAT_EQ(blend.transmission, 0.2f);
    EXPECT_EQ(material_of({{"_type", "_media"}, {"_media_type", "_sss"}}).surface, Surface::media);
}

TEST(VoxMaterial, emission_is_albedo_times_emit_times_two_to_the_flux) {
    const Material emitter = material_of({{"_type", "_emit"}, {"_emit", "0.5"}, {"_flux", "3"}});
    EXPECT_EQ(emitter.surface, Surface::emit);
    EXPECT_EQ(emitter.albedo, glm::vec3(1.0f));
    EXPECT_EQ(emitter.emission, glm::vec3(4.0f));
    EXPECT_EQ(material_of({{"_type", "_diffuse"}, {"_emit", "0.5"}, {"_flux", "3"}}).emission,
              glm::vec3(0.0f));
    EXPECT_EQ(material_of({{"_type", "_emit"}, {"_weight", "0.25"}}).emission, glm::vec3(0.25f));
}

TEST(VoxMaterial, broken_numbers_are_repaired_with_a_warning) {
    struct Row {
        Pairs properties;
        glm::vec3 emission;
        float roughness;
    };
    const Row rows[] = {
        {{{"_type", "_emit"}, {"_emit", "nan"}}, glm::vec3(1.0f), 1.0f},
        {{{"_type", "_emit"}, {"_emit", "1"}, {"_flux", "inf"}}, glm::vec3(65536.0f), 1.0f},
        {{{"_type", "_emit"}, {"_emit", "-3"}}, glm::vec3(0.0f), 1.0f},
        {{{"_rough", "1e30"}}, glm::vec3(0.0f), 1.0f},
        {{{"_rough", "-nan"}}, glm::vec3(0.0f), 1.0f},
        {{{"_rough", "half"}}, glm::vec3(0.0f), 1.0f},
        {{{"_type", "_slime"}}, glm::vec3(0.0f), 1.0f},
    };
    for (const Row& row : rows) {
        std::vector<std::string> warnings;
        const Material material = material_of(row.properties, &warnings);
        EXPECT_EQ(material.emission, row.emission) << row.properties.back().second;
        EXPECT_EQ(material.roughness, row.roughness);
        ASSERT_EQ(warnings.size(), 1u) << row.properties.back().second;
        EXPECT_TRUE(warnings[0].starts_with("material 1: ")) << warnings[0];
    }
}

TEST(VoxMaterial, old_materials_are_mapped_and_newer_ones_replace_them) {
    // Bits 1 (roughness), 3 (ior) and 5 (power) have values.
    const std::string old =
        chunk("MATT", i32(1) + i32(3) + f32(0.5f) + u32(0x2a) + f32(0.125f) + f32(0.25f) + f32(0.5f));
    std::vector<std::string> warnings;
    const Material emitter = vox_materials(read_good(chiral_model(2, 2, 2) + old), warnings)[1];
    EXPECT_EQ(emitter.surface, Surface::emit);
    EXPECT_EQ(emitter.roughness, 0.125f);
    EXPECT_EQ(emitter.ior, 1.25f);
    EXPECT_EQ(emitter.emission, glm::vec3(0.5f * 4.0f));
    const auto both = vox_materials(
        read_good(chiral_model(2, 2, 2) + old + record("MATL", 1, {{"_type", "_glass"}})), warnings);
    EXPECT_EQ(both[1].surface, Surface::glass);
    EXPECT_TRUE(warnings.empty());
}

TEST(VoxMaterial, ids_outside_the_palette_are_ignored) {
    std::vector<std::string> warnings;
    const VoxFile file =
        read_good(chiral_model(2, 2, 2) + record("MATL", 0, {{"_type", "_metal"}}) +
                  record("MATL", 256, {{"_type", "_metal"}}) + record("MATL", -1, {{"_type", "_metal"}}));
    for (const Material& material : vox_materials(file, warnings))
        EXPECT_EQ(material.surface, Surface::diffuse);
}

TEST(VoxScene, colours_become_linear_and_each_used_index_one_material) {
    const VoxFile file =
        read_good(size_chunk(2, 2, 2) + voxels_chunk({{0, 0, 0, 200}, {1, 0, 0, 128}, {1, 1, 0, 200}}) +
                  palette_chunk());
    const Scene scene = scene_from_vox(file);
    ASSERT_EQ(scene.materials.size(), 2u);
    // Colour 200 is (199, 56, ...): IEC 61966-2-1 written out once more.
    const double expected = std::pow((199 / 255.0 + 0.055) / 1.055, 2.4);
    EXPECT_FLOAT_EQ(scene.materials[0].albedo.r, static_cast<float>(expected));
    EXPECT_EQ(scene.materials[0].name, "palette 200");
    EXPECT_EQ(scene.models[0].voxels, (std::vector<Voxel>{{0, 0, 0, 0}, {1, 0, 0, 1}, {1, 1, 0, 0}}));
}

TEST(VoxScene, hidden_empty_and_unused_models_are_dropped) {
    const std::string chunks = chiral_model(2, 2, 2) + size_chunk(5, 5, 5) + voxels_chunk({}) +
                               chiral_model(3, 3, 3) + chiral_model(4, 4, 4) + transform(0, 1, -1, {{}}) +
                               group(1, {2, 4, 6, 8}) + transform(2, 3, 0, {{}}, {{"_hidden", "1"}}) +
                               shape(3, {{0, {}}}) + transform(4, 5, 0, {{}}) + shape(5, {{1, {}}}) +
                               transform(6, 7, 0, {{}}, {{"_name", "cube"}}) + shape(7, {{2, {}}}) +
                               transform(8, 7, 0, {{}});
    const Scene scene = scene_from_vox(read_good(chunks));
    ASSERT_EQ(scene.models.size(), 1u);
    EXPECT_EQ(scene.models[0].name, "cube");
    EXPECT_EQ(scene.models[0].size, glm::ivec3(3));
    EXPECT_EQ(scene.instances.size(), 2u);
}

TEST(VoxScene, appending_twice_shares_materials_and_keeps_models_apart) {
    Scene scene;
    const VoxFile file = read_good(chiral_model(2, 2, 2));
    append_vox(scene, file, 0, Rotation{}, {0, 0, 0});
    const std::size_t materials = scene.materials.size();
    append_vox(scene, file, 0, Rotation{}, {10, 0, 0});
    EXPECT_EQ(scene.materials.size(), materials);
    EXPECT_EQ(scene.models.size(), 2u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[1].model, 1u);
    EXPECT_EQ(world_cell(scene.instances[1], {2, 2, 2}, {0, 0, 0}), glm::ivec3(10, 0, 0));
}

TEST(VoxScene, warnings_of_the_file_reach_the_scene) {
    const Scene scene = scene_from_vox(read_good(chiral_model(2, 2, 2) + chunk("IMAP", "")));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("IMAP"), std::string::npos);
}

TEST(VoxInfo, json_has_every_name_of_the_contract) {
    const auto info = summarize(read_good(chiral_model(3, 4, 5)));
    ASSERT_TRUE(info);
    const auto json = to_json(info.value());
    for (const char* name : {"version", "models", "sizes", "voxels", "instances", "hidden_instances",
                             "instanced_voxels", "layers", "cameras", "materials", "palette", "colours_used",
                             "scene_box", "voxel_box", "max_frames", "out_of_size", "duplicates", "warnings"})
        EXPECT_TRUE(json.contains(name)) << name;
    EXPECT_EQ(json["scene_box"].dump(), "[[0,0,0],[3,4,5]]");
    EXPECT_EQ(json["palette"], "default");
}

TEST(VoxInfo, empty_file_has_no_boxes) {
    const auto info = summarize(read_good(""));
    ASSERT_TRUE(info);
    const auto json = to_json(info.value());
    EXPECT_TRUE(json["scene_box"].is_null());
    EXPECT_TRUE(json["voxel_box"].is_null());
    EXPECT_TRUE(json["materials"].is_object());
    EXPECT_TRUE(json["sizes"].is_array());
    EXPECT_NE(describe(info.value()).find("0 with 0 voxels"), std::string::npos);
}

TEST(VoxInfo, names_from_the_file_are_printable) {
    const auto info = summarize(read_good(chiral_model(2, 2, 2) +
                                          chunk("\xff\x01"
                                                "ab",
                                                "") +
                                          record("MATL", 1, {{"_type", "\xc3("}})));
    ASSERT_TRUE(info);
    const std::string json = to_json(info.value()).dump();  // throws when a text is not UTF-8
    EXPECT_NE(json.find(R"("\\xff\\x01ab":1)"), std::string::npos) << json;
    EXPECT_NE(json.find(R"("\\xc3(":1)"), std::string::npos) << json;
}

}  // namespace
}  // namespace voxilux
