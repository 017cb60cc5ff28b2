// Each feature of glTF that a voxel can show, in the smallest file that has it.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/gltf_builder.h"
#include "voxelizer/load_gltf.h"

namespace voxilux {
namespace {

using gltf_builder::bytes_of;
using gltf_builder::File;
using gltf_builder::json;
using gltf_builder::square;
using gltf_builder::textured_square;

Mesh load_built(const std::string& bytes, const MeshRequest& request = {}) {
    MeshNotes notes;
    Mesh mesh = load_gltf(std::as_bytes(std::span(bytes)), "", request, notes);
    mesh.warnings = note_lines(notes);
    return mesh;
}

// The corners of all triangles in their order, in millionths.
std::vector<glm::ivec3> corners(const Mesh& mesh) {
    std::vector<glm::ivec3> result;
    for (const MeshTriangle& triangle : mesh.triangles) {
        for (int c = 0; c < 3; ++c) {
            const glm::dvec3 p = mesh.positions.at(triangle.vertices[c]);
            result.emplace_back(std::lround(p.x * 1e6), std::lround(p.y * 1e6), std::lround(p.z * 1e6));
        }
    }
    return result;
}

std::vector<glm::ivec3> in_millionths(std::vector<glm::ivec3> corners) {
    for (glm::ivec3& corner : corners)
        corner *= 1000000;
    return corners;
}

const std::vector<glm::ivec3> kTwoTriangles =
    in_millionths({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}});

TEST(Gltf, text_and_binary_files_give_the_same_triangles) {
    EXPECT_EQ(corners(load_built(square().gltf())), kTwoTriangles);
    EXPECT_EQ(corners(load_built(square().glb())), kTwoTriangles);
}

TEST(Gltf, indices_of_one_two_and_four_bytes_are_read) {
    const auto with = [](int component, const std::string& bytes) {
        File file;
        const int positions = file.floats(gltf_builder::kSquare, 3);
        file.primitive({{"POSITION", positions}},
                       {{"indices", file.accessor(file.view(bytes), component, "SCALAR", 6)}});
        return corners(load_built(file.glb()));
    };
    EXPECT_EQ(with(5121, bytes_of(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3})), kTwoTriangles);
    EXPECT_EQ(with(5125, bytes_of(std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3})), kTwoTriangles);
    EXPECT_NE(with(5121, bytes_of(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 1})), kTwoTriangles);
}

TEST(Gltf, strips_and_fans_turn_as_lists_do) {
    const auto with = [](int mode, const std::vector<float>& positions) {
        File file;
        const int accessor = file.floats(positions, 3);
        file.primitive({{"POSITION", accessor}}, {{"mode", mode}});
        return corners(load_built(file.glb()));
    };
    EXPECT_EQ(with(6, gltf_builder::kSquare), kTwoTriangles);
    // Odd triangles of a strip take their last two corners in the other order.
    EXPECT_EQ(with(5, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}),
              in_millionths({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(with(5, {0, 0, 0, 1, 0, 0}).size(), 0u);
    EXPECT_EQ(with(4, gltf_builder::kSquare).size(), 3u) << "one vertex is left over";
}

TEST(Gltf, interleaved_vertices_are_read_by_their_stride) {
    File file;
    std::vector<float> both;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto p = gltf_builder::kSquare.begin() + static_cast<std::ptrdiff_t>(3 * i);
        both.insert(both.end(), {9, 9});
        both.insert(both.end(), p, p + 3);
    }
    const int view = file.view(bytes_of(both), 20);
    file.primitive({{"POSITION", file.accessor(view, 5126, "VEC3", 4, {{"byteOffset", 8}})}}, {{"mode", 6}});
    EXPECT_EQ(corners(load_built(file.glb())), kTwoTriangles);
    file.root["accessors"][0]["byteOffset"] = 4;
    EXPECT_NE(corners(load_built(file.glb())), kTwoTriangles);
}

// The square whose corner 3 comes from sparse values, over a view or over nothing.
File sparse_square(bool has_view) {
    File file;
    std::vector<float> base = gltf_builder::kSquare;
    base[9] = 77;
    const std::vector<float> all = gltf_builder::kSquare, last = {0, 1, 0};
    const std::vector<std::uint8_t> places =
        has_view ? std::vector<std::uint8_t>{3} : std::vector<std::uint8_t>{0, 1, 2, 3};
    const json sparse = {{"count", places.size()},
                         {"indices", {{"bufferView", file.view(bytes_of(places))}, {"componentType", 5121}}},
                         {"values", {{"bufferView", file.view(bytes_of(has_view ? last : all))}}}};
    const int view = has_view ? file.view(bytes_of(base)) : -1;
    file.primitive({{"POSITION", file.accessor(view, 5126, "VEC3", 4, {{"sparse", sparse}})}}, {{"mode", 6}});
    return file;
}

TEST(Gltf, sparse_values_replace_those_of_the_view_or_zeros) {
    EXPECT_EQ(corners(load_built(sparse_square(true).glb())), kTwoTriangles);
    EXPECT_EQ(corners(load_built(sparse_square(false).glb())), kTwoTriangles);
}

TEST(Gltf, quantised_positions_are_read) {
    File file;
    const std::vector<std::int16_t> positions = {-1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, -1, 1, 0, 0};
    file.primitive({{"POSITION", file.accessor(file.view(bytes_of(positions), 8), 5122, "VEC3", 4)}},
                   {{"mode", 6}});
    EXPECT_EQ(corners(load_built(file.glb()))[0], glm::ivec3(-1000000, 0, 0));
    file.root["accessors"][0]["normalized"] = true;
    EXPECT_EQ(corners(load_built(file.glb()))[0], glm::ivec3(-31, 0, 0)) << "1 / 32767";
}

TEST(Gltf, normalised_vertex_colours_are_linear_and_opaque_without_alpha) {
    File file = square();
    const std::vector<std::uint16_t> colors(12, 13107);
    const int view = file.view(bytes_of(colors), 6);
    file.root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
        file.accessor(view, 5123, "VEC3", 4, {{"normalized", true}});
    const Mesh mesh = load_built(file.glb());
    ASSERT_EQ(mesh.colors.size(), 4u);
    EXPECT_NEAR(mesh.colors[2].r, 0.2f, 1e-6f);
    EXPECT_EQ(mesh.colors[2].a, 1.0f);
}

TEST(Gltf, part_without_colours_beside_one_with_them_is_white) {
    File file = square();
    const int other = file.floats(gltf_builder::kSquare, 3);
    const int colors = file.floats(std::vector<float>(16, 0.25f), 4);
    file.primitive({{"POSITION", other}, {"COLOR_0", colors}}, {{"mode", 6}});
    file.primitive({{"POSITION", other}}, {{"mode", 6}});
    const Mesh mesh = load_built(file.glb());
    ASSERT_EQ(mesh.colors.size(), 12u);
    EXPECT_EQ(mesh.colors[0], glm::vec4(1.0f));
    EXPECT_EQ(mesh.colors[4], glm::vec4(0.25f));
    EXPECT_EQ(mesh.colors[11], glm::vec4(1.0f));
}

TEST(Gltf, parts_of_one_node_share_their_vertices) {
    File file = square();
    file.root["meshes"][0]["primitives"].push_back(file.root["meshes"][0]["primitives"][0]);
    const Mesh mesh = load_built(file.glb());
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.triangles.size(), 4u);
}

TEST(GltfNodes, matrix_and_its_parts_place_alike) {
    File parts = square();
    const double h = std::sqrt(0.5);
    parts.root["nodes"] = {{{"children", {1}}, {"translation", {1, 2, 3}}},
                           {{"mesh", 0}, {"rotation", {0, 0, h, h}}, {"scale", {2, 3, -4}}}};
    File matrix = square();
    // Columns: x goes to 2 y, y to -3 x, z to -4 z.
    matrix.root["nodes"] = {{{"mesh", 0}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, -4, 0, 1, 2, 3, 1}}}};
    EXPECT_EQ(corners(load_built(parts.glb())), corners(load_built(matrix.glb())));
    EXPECT_EQ(corners(load_built(matrix.glb()))[2], glm::ivec3(-2000000, 4000000, 3000000));
}

TEST(GltfNodes, chain_of_30000_nodes_is_walked) {
    File file = square();
    constexpr int kNodes = 30000;
    json nodes = json::array();
    for (int i = 0; i + 1 < kNodes; ++i)
        nodes.push_back({{"children", {i + 1}}, {"translation", {0, 0, 1}}});
    nodes.push_back({{"mesh", 0}});
    file.root["nodes"] = nodes;
    EXPECT_EQ(load_built(file.glb()).positions.at(0).z, kNodes - 1);
}

TEST(GltfNodes, chosen_scene_is_read_and_the_list_is_shown_for_a_wrong_one) {
    File file = square();
    file.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}};
    file.root["scenes"] = {
        {{"nodes", {0}}, {"name", "Main"}}, {{"nodes", {1}}, {"name", "Side"}}, {{"nodes", {0, 1}}}};
    EXPECT_EQ(load_built(file.glb()).positions.at(0).x, 0.0);
    file.root["scene"] = 1;
    EXPECT_EQ(load_built(file.glb()).positions.at(0).x, 5.0);
    EXPECT_EQ(load_built(file.glb(), {.scene = 2}).triangles.size(), 4u);
    try {
        (void)load_built(file.glb(), {.scene = 3});
        FAIL();
    } catch (const MeshFault& fault) {
        EXPECT_STREQ(fault.what(), "there is no scene 3; the file has 3: 0 'Main', 1 'Side', 2 ''");
    }
}

TEST(GltfNodes, every_root_stands_in_a_file_without_scenes) {
    File file = square();
    file.root.erase("scenes");
    file.root["nodes"] = {{{"mesh", 0}}, {{"children", {0}}}, {{"mesh", 0}}};
    EXPECT_EQ(load_built(file.glb()).triangles.size(), 4u);
}

TEST(GltfNodes, cameras_look_along_their_nodes) {
    File file = square();
    file.root["cameras"] = {
        {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}}}}};
    const double h = std::sqrt(0.5);
    file.root["nodes"] = {{{"mesh", 0}, {"children", {1, 2}}},
                          {{"camera", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, h, 0, h}}},
                          {{"camera", 1}}};
    const Mesh mesh = load_built(file.glb());
    ASSERT_EQ(mesh.cameras.size(), 1u);
    EXPECT_EQ(mesh.cameras[0].name, "eye");
    EXPECT_EQ(mesh.cameras[0].position, glm::dvec3(1, 2, 3));
    EXPECT_NEAR(glm::distance(mesh.cameras[0].forward, glm::dvec3(-1, 0, 0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(mesh.cameras[0].up, glm::dvec3(0, 1, 0)), 0.0, 1e-12);
    EXPECT_NEAR(mesh.cameras[0].fov_y_deg, 57.29577951, 1e-6);
    EXPECT_EQ(mesh.warnings.size(), 1u);
}

TEST(GltfMaterial, texture_keeps_its_texels_wrap_modes_and_filter) {
    File file = textured_square();
    file.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    file.root["textures"][0]["sampler"] = 0;
    const Mesh mesh = load_built(file.gltf());
    ASSERT_EQ(mesh.textures.size(), 1u);
    const Texture& texture = mesh.textures[0];
    EXPECT_EQ(texture.size, glm::ivec2(2, 2));
    EXPECT_EQ(texture.texels.at(0), glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(texture.texels.at(2), glm::u8vec4(0, 0, 255, 255)) << "row 0 is on top";
    EXPECT_EQ(texture.wrap_u, TextureWrap::clamp_to_edge);
    EXPECT_EQ(texture.wrap_v, TextureWrap::mirrored_repeat);
    EXPECT_TRUE(texture.is_nearest);
    EXPECT_TRUE(mesh.warnings.empty());
}

TEST(GltfMaterial, texture_transform_is_translation_rotation_scale) {
    File file = textured_square();
    file.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
             ["KHR_texture_transform"] = {
        {"offset", {0.5, 0.25}}, {"rotation", std::acos(0.0)}, {"scale", {2, 3}}};
    const Mesh mesh = load_built(file.glb());
    const auto& use = mesh.materials.at(0).base_color_texture;
    ASSERT_TRUE(use.has_value());
    // The extension's rotation: (u, v) goes to (u cos + v sin, v cos - u sin).
    const glm::dvec3 uv = use->transform * glm::dvec3(0.1, 0.2, 1.0);
    EXPECT_NEAR(uv.x, 0.5 + 0.2 * 3, 1e-12);
    EXPECT_NEAR(uv.y, 0.25 - 0.1 * 2, 1e-12);
}

TEST(GltfMaterial, second_coordinates_are_used_where_the_transform_names_them) {
    File file = textured_square();
    file.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
        file.floats({5, 0, 6, 0, 6, 1, 5, 1}, 2);
    json& info = file.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    info["extensions"]["KHR_texture_transform"] = {{"texCoord", 1}};
    const Mesh mesh = load_built(file.glb());
    EXPECT_EQ(mesh.materials.at(0).base_color_texture->uv_set, 1u);
    EXPECT_EQ(mesh.uv1.at(0), glm::vec2(5, 0));
    info["extensions"]["KHR_texture_transform"]["texCoord"] = 2;
    const Mesh third = load_built(file.glb());
    EXPECT_FALSE(third.materials.at(0).base_color_texture.has_value());
    EXPECT_EQ(third.warnings.size(), 1u);
}

TEST(GltfMaterial, mesh_without_coordinates_gets_the_material_without_texture) {
    File file = textured_square();
    const int bare = file.floats(gltf_builder::kSquare, 3);
    file.primitive({{"POSITION", bare}}, {{"mode", 6}, {"material", 0}});
    const Mesh mesh = load_built(file.glb());
    ASSERT_EQ(mesh.materials.size(), 2u);
    EXPECT_TRUE(mesh.materials[mesh.triangles.front().material].base_color_texture.has_value());
    EXPECT_FALSE(mesh.materials[mesh.triangles.back().material].base_color_texture.has_value());
    EXPECT_EQ(mesh.textures.size(), 1u);
    EXPECT_EQ(mesh.warnings.size(), 1u);
}

TEST(GltfMaterial, factors_and_extensions_are_read) {
    File file = square();
    file.root["materials"] = {
        {{"name", "lamp"},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.3},
         {"emissiveFactor", {1, 0.5, 0}},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.7}, {"roughnessFactor", 0.6}}},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
           {"KHR_materials_ior", {{"ior", 1.33}}}}}}};
    file.root["meshes"][0]["primitives"][0]["material"] = 0;
    const MeshMaterial material = load_built(file.glb()).materials.at(0);
    EXPECT_EQ(material.name, "lamp");
    EXPECT_EQ(material.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
    EXPECT_FLOAT_EQ(material.alpha_cutoff, 0.3f);
    EXPECT_FLOAT_EQ(material.metallic, 0.7f);
    EXPECT_FLOAT_EQ(material.roughness, 0.6f);
    EXPECT_EQ(material.emissive, glm::vec3(4, 2, 0));
    EXPECT_FLOAT_EQ(material.transmission, 0.9f);
    EXPECT_FLOAT_EQ(material.ior, 1.33f);
}

TEST(GltfMaterial, diffuse_colour_of_specular_glossiness_is_the_base_colour) {
    File file = square();
    file.root["materials"] = {{{"extensions",
                                {{"KHR_materials_pbrSpecularGlossiness",
                                  {{"diffuseFactor", {0.5, 0.25, 1, 1}}, {"glossinessFactor", 0.75}}}}}}};
    file.root["meshes"][0]["primitives"][0]["material"] = 0;
    const Mesh mesh = load_built(file.glb());
    EXPECT_EQ(mesh.materials.at(0).base_color, glm::vec4(0.5f, 0.25f, 1, 1));
    EXPECT_EQ(mesh.materials.at(0).metallic, 0.0f);
    EXPECT_FLOAT_EQ(mesh.materials.at(0).roughness, 0.25f);
    EXPECT_EQ(mesh.warnings.size(), 1u);
}

TEST(GltfMaterial, missing_image_costs_the_texture_and_is_noted) {
    File file = textured_square();
    file.root["images"] = {{{"uri", "nowhere.png"}}};
    const Mesh mesh = load_built(file.glb());
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_FALSE(mesh.materials.at(0).base_color_texture.has_value());
    ASSERT_EQ(mesh.warnings.size(), 1u);
    EXPECT_NE(mesh.warnings[0].find("nowhere.png"), std::string::npos);
}

TEST(GltfNotes, triangles_with_vertices_that_are_not_finite_are_left_out_and_counted) {
    File file;
    std::vector<float> positions;
    for (const float bad : {0.0f, NAN, INFINITY}) {
        positions.insert(positions.end(), {0, 0, 0, 1, 0, bad, 0, 1, 0});
    }
    const int accessor = file.floats(positions, 3);
    file.primitive({{"POSITION", accessor}});
    const Mesh mesh = load_built(file.glb());
    EXPECT_EQ(mesh.triangles.size(), 1u);
    ASSERT_EQ(mesh.warnings.size(), 1u);
    EXPECT_EQ(mesh.warnings[0], "a triangle is left out: a vertex is not finite (2 times)");
}

TEST(GltfNotes, degenerate_triangles_stay) {
    File file;
    const int accessor = file.floats({1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 1, 0, 0, 2, 0, 0}, 3);
    file.primitive({{"POSITION", accessor}});
    EXPECT_EQ(load_built(file.glb()).triangles.size(), 2u);
}

TEST(GltfNotes, what_is_not_read_is_named) {
    File file = square();
    file.root["nodes"][0]["skin"] = 0;
    file.root["meshes"][0]["primitives"][0]["targets"] = json::array({json::object()});
    file.primitive({{"POSITION", 0}}, {{"mode", 1}});
    file.primitive(json::object());
    const Mesh mesh = load_built(file.glb());
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.warnings.size(), 4u);
}

}  // namespace
}  // namespace voxilux
