// .stl, .ply and .xyz: read as they were written, in every encoding, and point clouds as voxels.

#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <random>

#include "base/colour.h"
#include "support/allocation_counter.h"
#include "support/mesh_file_builder.h"
#include "voxelizer/load_las.h"
#include "voxelizer/load_ply.h"
#include "voxelizer/load_stl.h"
#include "voxelizer/load_xyz.h"
#include "voxelizer/voxelize_points.h"

namespace voxilux {
namespace {

using namespace mesh_file_builder;

using MeshLoader = Mesh (*)(std::span<const std::byte>, const std::filesystem::path&, const MeshRequest&,
                            MeshNotes&);

Mesh loaded_by(MeshLoader load, const std::string& text, const MeshRequest& request = {}) {
    MeshNotes notes;
    return load(std::as_bytes(std::span(text)), "", request, notes);
}

struct Corner {
    glm::vec3 position{0.0f};
    glm::vec3 colour{1.0f};
    bool operator==(const Corner&) const = default;
};

std::vector<Corner> corners_of(const Mesh& mesh) {
    std::vector<Corner> corners;
    for (const MeshTriangle& triangle : mesh.triangles)
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t v = triangle.vertices[c];
            corners.push_back({glm::vec3(mesh.positions[v]),
                               mesh.colors.empty() ? glm::vec3(1.0f) : glm::vec3(mesh.colors[v])});
        }
    return corners;
}

std::vector<Corner> expected_corners(const PlainMesh& mesh, bool has_colours) {
    std::vector<Corner> corners;
    for (const glm::uvec3 triangle : mesh.triangles)
        for (int c = 0; c < 3; ++c) {
            const glm::u8vec3 code = mesh.colours[triangle[c]];
            corners.push_back({mesh.positions[triangle[c]],
                               has_colours ? glm::vec3(linear_from_srgb(code.r), linear_from_srgb(code.g),
                                                       linear_from_srgb(code.b))
                                           : glm::vec3(1.0f)});
        }
    return corners;
}

TEST(MeshFormats, ten_meshes_in_each_encoding_have_the_triangles_that_were_written) {
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        const PlainMesh mesh = random_mesh(seed);
        for (const std::string& text : {stl_binary(mesh), stl_text(mesh)})
            EXPECT_EQ(corners_of(loaded_by(load_stl, text)), expected_corners(mesh, false)) << seed;
        for (const PlyWriting writing :
             {PlyWriting::text, PlyWriting::little_endian, PlyWriting::big_endian}) {
            const Mesh loaded = loaded_by(load_ply, ply(mesh, writing));
            EXPECT_EQ(corners_of(loaded), expected_corners(mesh, true)) << seed;
            EXPECT_TRUE(loaded.is_z_up);
        }
    }
}

TEST(MeshFormats, comparison_sees_a_swapped_byte_order_and_a_changed_vertex) {
    const PlainMesh mesh = random_mesh(3);
    std::string swapped = ply(mesh, PlyWriting::little_endian);
    swapped.replace(swapped.find("little"), 6, "big");
    EXPECT_THROW((void)loaded_by(load_ply, swapped), MeshFault);
    std::string changed = stl_binary(mesh);
    changed[84 + 12 + 2] ^= 1;
    EXPECT_NE(corners_of(loaded_by(load_stl, changed)), expected_corners(mesh, false));
}

TEST(MeshFormats, quads_are_cut_and_faces_of_two_corners_are_noted) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_index\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n2 0 1\n";
    MeshNotes notes;
    const Mesh mesh = load_ply(std::as_bytes(std::span(text)), "", {}, notes);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(notes.size(), 1u);
}

TEST(MeshFormats, backslashes_and_hashes_are_text_in_ply_and_stl) {
    const PlainMesh mesh = random_mesh(2);
    std::string stl = stl_text(mesh), text = ply(mesh, PlyWriting::text);
    stl.insert(stl.find('\n'), " C:\\models\\#1\\");
    stl.insert(stl.find("vertex"), "outer loop\\\n");
    text.insert(text.find("element"), "comment C:\\models\\\n");
    EXPECT_EQ(corners_of(loaded_by(load_stl, stl)), expected_corners(mesh, false));
    EXPECT_EQ(corners_of(loaded_by(load_ply, text)), expected_corners(mesh, true));
}

TEST(MeshFormats, stl_words_may_be_upper_case_and_binary_files_longer) {
    const PlainMesh mesh = random_mesh(2);
    std::string text = stl_text(mesh), binary = stl_binary(mesh);
    for (char& c : text)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_EQ(corners_of(loaded_by(load_stl, text)), expected_corners(mesh, false));
    binary.replace(0, 5, "solid");
    binary += "more";
    MeshNotes notes;
    const Mesh loaded = load_stl(std::as_bytes(std::span(binary)), "", {}, notes);
    EXPECT_EQ(corners_of(loaded), expected_corners(mesh, false));
    EXPECT_EQ(notes.size(), 1u);
    EXPECT_THROW((void)loaded_by(load_stl, binary.substr(0, binary.size() - 5)), MeshFault) << "cut off";
}

TEST(MeshFormats, text_that_says_nonsense_is_refused) {
    const std::string ply_head =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n";
    const std::pair<MeshLoader, std::string> bad[] = {
        {load_stl, "solid\nfacet\nvertex 0 0 0\nendfacet\n"},
        {load_stl, "solid\nfacet\nvertex 0 0 0\nvertex 0 0 1\nvertex 1 0 0\nvertex 1 1 1\nendfacet\n"},
        {load_stl, "solid\nvertex 0 0\n"},
        {load_stl, "solid\nfacett\n"},
        {load_stl, ""},
        {load_ply, ply_head + "end_header\n0 0\n"},
        {load_ply, ply_head + "property float z\nend_header\n0 0 x\n"},
        {load_ply,
         ply_head +
             "property float z\nelement face 9\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n"},
        {load_ply, ply_head + "property float z\n"},
        {load_ply, "ply\nformat ascii 2.0\nend_header\n"},
        {load_ply, "ply\nformat ascii 1.0\nelement vertex 99999999999999\nproperty float x\nend_header\n"},
        {load_xyz, "1 2\n"},
        {load_xyz, "# nothing\n"},
        {load_xyz, "1 2 a\n"},
    };
    for (const auto& [load, text] : bad)
        EXPECT_THROW((void)loaded_by(load, text), MeshFault) << text;
}

TEST(MeshFormats, mutated_files_are_refused_or_load_in_bounded_memory) {
    constexpr MeshRequest kRequest{.limits = {.vertices = 1 << 12, .triangles = 1 << 12}};
    constexpr std::size_t kFixedMeshBytes = std::size_t{1} << 20;
    const PlainMesh mesh = random_mesh(9);
    const std::pair<MeshLoader, std::string> files[] = {{load_stl, stl_binary(mesh)},
                                                        {load_stl, stl_text(mesh)},
                                                        {load_ply, ply(mesh, PlyWriting::text)},
                                                        {load_ply, ply(mesh, PlyWriting::little_endian)},
                                                        {load_ply, ply(mesh, PlyWriting::big_endian)},
                                                        {load_xyz, xyz(mesh)},
                                                        {load_las, las(mesh, 3, 13)}};
    std::mt19937 random(77);
    for (const auto& [load, text] : files) {
        int refused = 0, loaded = 0;
        for (int round = 0; round < 1000; ++round) {
            std::string bytes = text;
            if (random() % 4 == 0) bytes.resize(random() % bytes.size());
            for (unsigned i = random() % 4; i > 0 && !bytes.empty(); --i)
                bytes[random() % bytes.size()] =
                    static_cast<char>(random() % 2 == 0 ? random() : '0' + random() % 10);
            const PeakAllocation peak;
            try {
                const Mesh result = loaded_by(load, bytes, kRequest);
                for (const MeshTriangle& triangle : result.triangles)
                    for (int c = 0; c < 3; ++c)
                        ASSERT_LT(triangle.vertices[c], result.positions.size());
                ++loaded;
            } catch (const MeshFault& fault) {
                EXPECT_STRNE(fault.what(), "");
                ++refused;
            }
            EXPECT_LE(peak.bytes(), kFixedMeshBytes + 64 * bytes.size());
        }
        EXPECT_GT(refused, 10);
        EXPECT_GT(loaded, 50);
    }
}

// The cells of points and the mean of their colours, computed the simple way.
std::map<std::array<int, 3>, glm::dvec4> averaged(const PlainMesh& mesh, int resolution) {
    glm::dvec3 low(1e30), high(-1e30);
    for (const glm::vec3 p : mesh.positions) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    const glm::dvec3 extent = high - low;
    const double scale = resolution / std::max({extent.x, extent.y, extent.z});
    std::map<std::array<int, 3>, glm::dvec4> cells;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        std::array<int, 3> cell{};
        for (int axis = 0; axis < 3; ++axis) {
            const double at = (mesh.positions[i][axis] - low[axis]) * scale;
            const int last = std::max(0, static_cast<int>(std::ceil(extent[axis] * scale - 1e-6)) - 1);
            cell[static_cast<std::size_t>(axis)] = std::min(last, static_cast<int>(at));
        }
        const glm::u8vec3 c = mesh.colours[i];
        cells[cell] +=
            glm::dvec4(decode_srgb(c.r / 255.0), decode_srgb(c.g / 255.0), decode_srgb(c.b / 255.0), 1.0);
    }
    return cells;
}

TEST(PointClouds, cells_hold_the_mean_of_their_points_in_linear_light) {
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        const PlainMesh mesh = random_mesh(seed * 20);
        const int resolution = 3 + static_cast<int>(seed);
        auto expected = averaged(mesh, resolution);
        const std::pair<MeshLoader, std::string> files[] = {
            {load_xyz, xyz(mesh)}, {load_ply, ply_points(mesh, PlyWriting::big_endian)}};
        for (const auto& [load, text] : files) {
            const VoxelSet set = voxelize_points(loaded_by(load, text), {.resolution = resolution});
            EXPECT_EQ(set.surface, expected.size());
            for (const VoxelBlock& block : set.blocks)
                for (const ColouredVoxel& voxel : block.surface) {
                    const glm::dvec4 sum = expected[{voxel.x, voxel.y, voxel.z}];
                    ASSERT_GT(sum.w, 0.0) << seed;
                    const glm::vec3 mean(glm::dvec3(sum) / sum.w);
                    EXPECT_EQ(glm::ivec3(voxel.r, voxel.g, voxel.b),
                              glm::ivec3(srgb_code(mean.r), srgb_code(mean.g), srgb_code(mean.b)));
                }
        }
    }
}

TEST(PointClouds, las_points_of_every_format_have_their_places_and_colours) {
    for (int format = 0; format <= 10; ++format) {
        const PlainMesh mesh = random_mesh(static_cast<std::uint32_t>(format) + 5);
        const bool has_colours = las_has_colours(format);
        for (const int version : {10, 12, 14}) {
            const Mesh loaded = loaded_by(load_las, las(mesh, format, version));
            ASSERT_EQ(loaded.positions.size(), mesh.positions.size());
            EXPECT_TRUE(loaded.is_z_up);
            ASSERT_EQ(loaded.colors.size(), has_colours ? mesh.positions.size() : 0u) << format;
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                EXPECT_EQ(loaded.positions[i] - kLasOffset, glm::dvec3(mesh.positions[i])) << format;
                const glm::u8vec3 c = mesh.colours[i];
                const glm::vec4 linear(linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b),
                                       1);
                if (!has_colours) continue;
                EXPECT_EQ(loaded.colors[i], linear) << format << " " << version;
            }
        }
    }
}

TEST(PointClouds, las_files_that_lie_or_are_compressed_are_refused) {
    const std::string good = las(random_mesh(3), 2, 12);
    const auto changed = [&](std::size_t at, const std::string& value) {
        return std::string(good).replace(at, value.size(), value);
    };
    for (const auto& [text, words] : {std::pair{good.substr(0, 200), "LASF"},
                                      {changed(0, "LASX"), "LASF"},
                                      {changed(24, "\2"), "version"},
                                      {changed(104, "\x82"), "LAZ"},
                                      {changed(104, "\x0b"), "format 11"},
                                      {changed(105, le(std::uint16_t{25})), "25 bytes"},
                                      {changed(107, le(0u)), "no point"},
                                      {changed(107, le(0x7FFFFFFFu)), "not read"},
                                      {changed(96, le(0xFFFFFFFFu)), "too short"},
                                      {good.substr(0, good.size() - 1), "too short"}}) {
        try {
            (void)loaded_by(load_las, text);
            ADD_FAILURE() << words;
        } catch (const MeshFault& fault) {
            EXPECT_NE(std::string_view(fault.what()).find(words), std::string_view::npos) << fault.what();
        }
    }
}

TEST(PointClouds, columns_that_are_no_colours_leave_white_and_a_note) {
    const std::string text = "0 0 0 0 0 1\n1 0 0 0.5 0.5 0.7\n";
    MeshNotes notes;
    const Mesh mesh = load_xyz(std::as_bytes(std::span(text)), "", {}, notes);
    EXPECT_TRUE(mesh.colors.empty());
    EXPECT_EQ(mesh.positions.size(), 2u);
    EXPECT_EQ(notes.size(), 1u);
}

TEST(PointClouds, lines_of_other_than_six_numbers_have_no_colours) {
    const std::string six = "0 0 0 10 20 30\n";
    for (const auto& [text, noted] : {std::pair{six + "1 0 0 7 10 20 30\n", true},
                                      {"1 0 0 10 20 30 7\n", true},
                                      {"1 0 0 99\n", true},
                                      {six + "1 0 0\n", true},
                                      {"1 0 0\n", false}}) {
        MeshNotes notes;
        const Mesh mesh = load_xyz(std::as_bytes(std::span(text)), "", {}, notes);
        EXPECT_TRUE(mesh.colors.empty()) << text;
        EXPECT_EQ(notes.size(), noted ? 1u : 0u) << text;
    }
    EXPECT_EQ(loaded_by(load_xyz, six).colors.size(), 1u);
}

}  // namespace
}  // namespace voxilux
