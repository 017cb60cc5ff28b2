// OBJ and MTL, from text and from files.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "support/gltf_builder.h"
#include "support/scratch_folder.h"
#include "voxelizer/load_mesh.h"
#include "voxelizer/load_mtl.h"
#include "voxelizer/load_obj.h"
#include "voxelizer/polygon.h"

namespace voxilux {
namespace {

Mesh load_text(const std::string& text) {
    MeshNotes notes;
    Mesh mesh = load_obj(std::as_bytes(std::span(text)), "no-such-folder", {}, notes);
    mesh.warnings = note_lines(notes);
    return mesh;
}

std::string refusal_of_text(const std::string& text) {
    try {
        (void)load_text(text);
        return "";
    } catch (const MeshFault& fault) {
        return fault.what();
    }
}

double area(const std::vector<glm::dvec3>& p, const std::array<std::uint32_t, 3>& t) {
    return 0.5 * glm::length(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, faces_are_cut_as_fans) {
    const Mesh mesh = load_text(kSquare + "f 1 2 3 4\n");
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangles[0].vertices, glm::uvec3(0, 1, 2));
    EXPECT_EQ(mesh.triangles[1].vertices, glm::uvec3(0, 2, 3));
    ASSERT_EQ(mesh.materials.size(), 1u);
    EXPECT_EQ(mesh.materials[0].metallic, 0.0f);
}

TEST(Obj, negative_indices_count_from_the_lines_before) {
    const Mesh mesh = load_text(kSquare + "f -4 -3 -2\nv 9 9 9\nf -1 1 2\n");
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.positions[mesh.triangles[0].vertices.x], glm::dvec3(0, 0, 0));
    EXPECT_EQ(mesh.positions[mesh.triangles[1].vertices.x], glm::dvec3(9, 9, 9));
}

TEST(Obj, corners_share_a_vertex_where_place_and_coordinate_agree) {
    const Mesh mesh = load_text(kSquare + "vt 0 0\nvt 1 0.25\nf 1/1 2/2 3/1\nf 1/1/7 3/1 4\nf 1/2 3//3 4\n");
    EXPECT_EQ(mesh.positions.size(), 6u) << "4 places, and 1/2 and 3 without coordinate beside 1/1 and 3/1";
    EXPECT_EQ(mesh.uv0.at(mesh.triangles[0].vertices.y), glm::vec2(1.0f, 0.75f)) << "v goes up in OBJ";
}

TEST(Obj, vertex_colours_are_srgb_and_missing_ones_white) {
    const Mesh mesh = load_text("v 0 0 0 0.5 0 1\nv 1 0 0\nv 0 1 0 1 1 1\nf 1 2 3\n");
    ASSERT_EQ(mesh.colors.size(), 3u);
    EXPECT_NEAR(mesh.colors[0].r, 0.21404114f, 1e-6f);
    EXPECT_EQ(mesh.colors[0].b, 1.0f);
    EXPECT_EQ(mesh.colors[1], glm::vec4(1.0f));
    EXPECT_TRUE(load_text("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n").colors.empty())
        << "a fourth number is w";
}

TEST(Obj, faces_with_numbers_that_are_not_finite_are_left_out_and_counted) {
    const Mesh mesh = load_text(kSquare + "v nan 0 0\nv 0 1e999 0\nf 1 2 3\nf 1 2 5 3\nf 1 6 2\n");
    EXPECT_EQ(mesh.triangles.size(), 1u);
    ASSERT_EQ(mesh.warnings.size(), 1u);
    EXPECT_EQ(mesh.warnings[0], "a triangle is left out: a vertex is not finite (3 times)");
}

TEST(Obj, comments_joined_lines_and_other_line_ends_are_read) {
    EXPECT_EQ(load_text("# head\r\nv 0 0 \\\r\n 0\r\nv +1 0 0 # one\r\n\tv 0 1 0\r\nf 1 \\\n2 \\\n3\n")
                  .triangles.size(),
              1u);
    EXPECT_EQ(load_text(kSquare + "f 1 2 3 \\").triangles.size(), 1u);
    EXPECT_EQ(load_text(kSquare + "f 1 2 3").triangles.size(), 1u);
}

TEST(Obj, lies_are_refused_with_their_line) {
    EXPECT_EQ(refusal_of_text(kSquare + "f 1 2 5\n"), "line 5: a face names line 5 of 4");
    EXPECT_EQ(refusal_of_text(kSquare + "f 1 2 0\n"), "line 5: a face names line 0 of 4");
    EXPECT_EQ(refusal_of_text(kSquare + "f 1 2 -5\n"), "line 5: a face names line -5 of 4");
    EXPECT_EQ(refusal_of_text(kSquare + "f 1/1 2 3\n"), "line 5: a face names line 1 of 0");
    EXPECT_EQ(refusal_of_text(kSquare + "f 1 2 99999999999999999999\n"),
              "line 5: '99999999999999999999' is not an index");
    EXPECT_EQ(refusal_of_text(kSquare + "f 1 2 x\n"), "line 5: 'x' is not an index");
    EXPECT_EQ(refusal_of_text(kSquare + "f 1 2\n"), "line 5: a face has fewer than three corners");
    EXPECT_EQ(refusal_of_text("v 1 2\n"), "line 1: a number is missing");
    EXPECT_EQ(refusal_of_text("v 1 2 3e\n"), "line 1: '3e' is not a number");
    EXPECT_EQ(refusal_of_text(kSquare + "f 1 2 -9223372036854775808\n"),
              "line 5: a face names line -9223372036854775808 of 4");
}

TEST(Polygon, concave_polygons_keep_their_area) {
    // An arrow head, a comb, and the head seen from behind.
    const std::vector<std::vector<glm::dvec3>> shapes = {
        {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}},
        {{0, 0, 1},
         {5, 0, 1},
         {5, 3, 1},
         {4, 3, 1},
         {4, 1, 1},
         {3, 1, 1},
         {3, 3, 1},
         {2, 3, 1},
         {2, 1, 1},
         {1, 1, 1},
         {1, 3, 1},
         {0, 3, 1}},
        {{0, 4, 0}, {2, 1, 0}, {4, 4, 0}, {4, 0, 0}, {0, 0, 0}},
    };
    const double areas[] = {10.0, 11.0, 10.0};
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        double sum = 0.0, fan = 0.0;
        const auto triangles = triangulate(shapes[i]);
        EXPECT_EQ(triangles.size(), shapes[i].size() - 2);
        for (const auto& triangle : triangles)
            sum += area(shapes[i], triangle);
        for (std::uint32_t k = 2; k < shapes[i].size(); ++k)
            fan += area(shapes[i], {0, k - 1, k});
        EXPECT_NEAR(sum, areas[i], 1e-12);
        if (i > 0) {
            EXPECT_GT(fan, areas[i] + 0.5) << "a fan would cover what is not there";
        }
    }
}

TEST(Polygon, crossing_flat_and_giant_polygons_end) {
    std::vector<glm::dvec3> star, line, wheel;
    for (int i = 0; i < 201; ++i) {
        star.emplace_back(std::cos(i * 2.2), std::sin(i * 2.2 + 0.3 * (i % 3)), 0.0);
        line.emplace_back(i % 7, 0.0, 0.0);
    }
    for (int i = 0; i < 100000; ++i)
        wheel.emplace_back(std::cos(i), std::sin(i), 0.0);
    EXPECT_EQ(triangulate(star).size(), 199u);
    EXPECT_EQ(triangulate(line).size(), 199u);
    EXPECT_EQ(triangulate(wheel).size(), 99998u);
}

MeshMaterial material(const std::string& fields, MeshNotes& notes) {
    MtlLibrary library{.folder = "no-such-folder", .budget = {}, .materials = {}, .textures = {}};
    Mesh mesh;
    read_mtl("newmtl a\n" + fields, library, mesh, notes);
    return mesh.materials.at(0);
}

TEST(Mtl, fields_are_read) {
    MeshNotes notes;
    const MeshMaterial a = material("Kd 0.5 0.25 1\nd 0.5\nKe 1 2 3\nNi 1.3\nPm 0.5\nPr 0.25\n", notes);
    EXPECT_EQ(a.base_color, glm::vec4(0.5f, 0.25f, 1.0f, 0.5f));
    EXPECT_EQ(a.alpha_mode, AlphaMode::blend);
    EXPECT_EQ(a.emissive, glm::vec3(1, 2, 3));
    EXPECT_FLOAT_EQ(a.ior, 1.3f);
    EXPECT_EQ(a.metallic, 0.5f);
    EXPECT_EQ(a.roughness, 0.25f);
    const MeshMaterial b = material("Tr 0.25\nNs 6\nillum 7\n", notes);
    EXPECT_EQ(b.base_color, glm::vec4(1.0f, 1.0f, 1.0f, 0.75f));
    EXPECT_EQ(b.roughness, 0.5f) << "sqrt(2 / (6 + 2))";
    EXPECT_EQ(b.transmission, 1.0f);
    EXPECT_EQ(material("Kd 1 1 1\n", notes).alpha_mode, AlphaMode::opaque);
    EXPECT_TRUE(notes.empty());
    EXPECT_THROW((void)material("Ns x\n", notes), MeshFault);
}

void write(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

TEST(Obj, library_and_pictures_are_found_beside_the_file) {
    const ScratchFolder folder;
    const std::string obj = "mtllib my colours.mtl\nvt 0 0\nusemtl skin tone\nf 1/1 2/1 3/1\n";
    write(folder / "mesh/a.obj", kSquare + obj);
    write(folder / "mesh/my colours.mtl",
          "newmtl skin tone\nmap_Kd -s 2 4 1 -o 0.5 0.25 -clamp on C:\\pictures\\a b.png\n"
          "newmtl other\nmap_Kd pictures/gone.png\n");
    write(folder / "mesh/a b.png", gltf_builder::small_png());
    const Mesh mesh = load_mesh(folder / "mesh/a.obj");
    const MeshMaterial& material = mesh.materials.at(mesh.triangles.at(0).material);
    EXPECT_EQ(material.name, "skin tone");
    ASSERT_TRUE(material.base_color_texture.has_value());
    EXPECT_EQ(mesh.textures.at(0).size, glm::ivec2(2, 2));
    EXPECT_EQ(mesh.textures.at(0).wrap_u, TextureWrap::clamp_to_edge);
    // The file's v = 0.3 is 0.7 here; scaled and moved it is 0.3 * 4 + 0.25, and that is -0.45 from the top.
    const glm::dvec3 uv = material.base_color_texture->transform * glm::dvec3(0.1, 0.7, 1.0);
    EXPECT_NEAR(uv.x, 0.7, 1e-12);
    EXPECT_NEAR(uv.y, 1.0 - 1.45, 1e-12);
    ASSERT_EQ(mesh.warnings.size(), 1u) << "the picture that is gone";
    EXPECT_THROW((void)load_mesh(folder / "mesh/a.obj", {.is_strict = true}), Error);
}

TEST(Obj, library_serves_faces_wherever_it_is_named) {
    const ScratchFolder folder;
    write(folder / "a.mtl", "\xEF\xBB\xBFnewmtl red\nKd 1 0 0\n");
    for (const std::string faces :
         {"mtllib a.mtl\nusemtl red\nf 1 2 3\n", "usemtl red\nmtllib a.mtl\nf 1 2 3\n",
          "usemtl red\nf 1 2 3\nmtllib a.mtl\n"}) {
        write(folder / "a.obj", kSquare + faces);
        const Mesh mesh = load_mesh(folder / "a.obj");
        EXPECT_TRUE(mesh.warnings.empty()) << faces;
        EXPECT_EQ(mesh.materials.at(mesh.triangles.at(0).material).name, "red") << faces;
    }
}

TEST(Obj, byte_order_mark_is_no_part_of_the_first_word) {
    const Mesh mesh = load_text("\xEF\xBB\xBF" + kSquare + "f 1 2 3\n");
    EXPECT_EQ(mesh.positions.at(mesh.triangles.at(0).vertices.x), glm::dvec3(0, 0, 0));
    EXPECT_TRUE(mesh.warnings.empty());
    EXPECT_NE(refusal_of_text("\xEF\xBB\xBF\xEF\xBB\xBF" + kSquare + "f 1 2 4\n"), "");
}

std::string refusal_of_text(const std::filesystem::path& path) {
    try {
        (void)load_mesh(path);
        return "";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        return error.what();
    }
}

TEST(LoadMesh, refusals_name_the_file_and_the_reason) {
    const ScratchFolder folder;
    write(folder / "a.stl", "solid");
    write(folder / "a.xyz", "1 2 3\n");
    write(folder / "a.obj", kSquare);
    write(folder / "b.obj", "v nan 0 0\nf 1 1 1\n");
    write(folder / "a.GLTF", "{");
    const std::string place = folder.path().string();
    EXPECT_EQ(refusal_of_text(folder / "a.stp"),
              place + "/a.stp: not a mesh: .gltf, .glb, .obj, .stl, .ply, .xyz, .las files are read");
    EXPECT_EQ(refusal_of_text(folder / "a.stl"), place + "/a.stl: no triangles");
    EXPECT_EQ(refusal_of_text(folder / "a.xyz"),
              place + "/a.xyz: a cloud of points; 'voxilux convert' makes it voxels");
    EXPECT_EQ(refusal_of_text(folder / "a.obj"), place + "/a.obj: no triangles");
    EXPECT_EQ(refusal_of_text(folder / "b.obj"),
              place + "/b.obj: no triangles are left: a triangle is left out: a vertex is not finite");
    EXPECT_EQ(refusal_of_text(folder / "a.GLTF"), place + "/a.GLTF: not valid JSON at byte 2");
    EXPECT_NE(refusal_of_text(folder / "gone.glb").find("cannot open"), std::string::npos);
}

TEST(LoadMesh, coordinates_that_no_texture_reads_are_dropped) {
    const ScratchFolder folder;
    gltf_builder::File file = gltf_builder::textured_square();
    write(folder / "a.glb", file.glb());
    EXPECT_EQ(load_mesh(folder / "a.glb").uv0.size(), 4u);
    file.root["materials"][0].erase("pbrMetallicRoughness");
    write(folder / "b.glb", file.glb());
    EXPECT_TRUE(load_mesh(folder / "b.glb").uv0.empty());
}

}  // namespace
}  // namespace voxilux
