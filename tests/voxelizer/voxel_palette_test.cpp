// Colours, the palette, and the file that comes out.

#include "voxelizer/voxel_palette.h"
#include "formats/vox_read.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

#include "base/colour.h"
#include "base/file.h"
#include "formats/vox_write.h"
#include "scene/vox_instances.h"
#include "scene/vox_material.h"
#include "support/mesh_shapes.h"
#include "support/scratch_folder.h"
#include "voxelizer/colour_spaces.h"
#include "voxelizer/linear_to_srgb.h"
#include "voxelizer/quantize_colours.h"
#include "voxelizer/vox_output.h"
#include "voxelizer/whole_section.h"

namespace voxilux {
namespace {

// A block of voxels with these colours, in a row.
VoxelSet set_of(const std::vector<ColouredVoxel>& voxels) {
    VoxelSet set;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (i % 4096 == 0) set.blocks.emplace_back();
        ColouredVoxel voxel = voxels[i];
        voxel.x = static_cast<std::uint8_t>(i % 16);
        voxel.y = static_cast<std::uint8_t>(i / 16 % 16);
        voxel.z = static_cast<std::uint8_t>(i / 256 % 16);
        set.blocks.back().surface.push_back(voxel);
    }
    set.surface = voxels.size();
    return set;
}

ColouredVoxel coloured(int r, int g, int b, const Look& look = {}) {
    return {.r = static_cast<std::uint8_t>(r),
            .g = static_cast<std::uint8_t>(g),
            .b = static_cast<std::uint8_t>(b),
            .look = packed(look)};
}

std::vector<ColouredVoxel> random_colours(std::size_t count, const Look& look = {}) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> byte(0, 255);
    std::vector<ColouredVoxel> voxels;
    for (std::size_t i = 0; i < count; ++i)
        voxels.push_back(coloured(byte(random), byte(random), byte(random), look));
    return voxels;
}

TEST(LinearToSrgb, bytes_are_those_of_the_formula) {
    for (int i = -10; i <= 40010; ++i) {
        const float linear = static_cast<float>(i) / 40000.0f;
        EXPECT_EQ(srgb_bytes(glm::vec3(linear)).g, srgb_code(linear)) << linear;
    }
}

// Published pairs: white, and the Oklab article's table for XYZ (1, 0, 0) is outside sRGB, so red by its
// matrices.
TEST(ColourSpaces, oklab_of_white_and_grey_has_no_chroma_and_returns) {
    EXPECT_NEAR(oklab_of(glm::u8vec3(255)).x, 1.0f, 1e-3f);
    EXPECT_NEAR(glm::length(glm::vec2(oklab_of(glm::u8vec3(128)).y, oklab_of(glm::u8vec3(128)).z)), 0.0f,
                1e-3f);
    for (const ColouredVoxel& v : random_colours(500)) {
        const glm::u8vec3 colour(v.r, v.g, v.b);
        EXPECT_EQ(srgb_of_oklab(oklab_of(colour)), colour);
    }
}

// CIELAB of the sRGB primaries under D65, as Lindbloom's calculator prints them.
TEST(ColourSpaces, cielab_of_the_primaries_is_as_published) {
    EXPECT_LT(glm::distance(cielab_of({255, 0, 0}), glm::dvec3(53.24, 80.09, 67.20)), 0.05);
    EXPECT_LT(glm::distance(cielab_of({0, 0, 255}), glm::dvec3(32.30, 79.19, -107.86)), 0.05);
    EXPECT_NEAR(colour_difference({0, 0, 0}, {255, 255, 255}), 100.0, 0.01);
}

TEST(QuantizeColours, error_of_uniform_colours_is_near_that_of_a_cubic_lattice) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> at(0.0f, 1.0f);
    std::vector<WeightedColour> colours;
    for (int i = 0; i < 8000; ++i)
        colours.push_back({.oklab = {at(random), at(random), at(random)}, .weight = 1.0f});
    const QuantizedColours result = quantize_colours(colours, 125);
    ASSERT_EQ(result.entries.size(), 125u);
    double square = 0.0;
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const glm::vec3 d = result.entries[result.entry_of[i]].oklab - colours[i].oklab;
        square += static_cast<double>(glm::dot(d, d)) / 8000.0;
    }
    constexpr double kCubic = 3.0 / 12.0 / 25.0;  // cells of 1/5
    EXPECT_LT(square, 1.05 * kCubic);
    EXPECT_GT(square, 0.7 * kCubic);  // the best lattice has 0.94 of it; finite samples give less
}

TEST(VoxelPalette, few_colours_are_exact) {
    std::vector<ColouredVoxel> voxels;
    for (int i = 0; i < 255; ++i)
        voxels.push_back(coloured(i, 100, 101 + i % 2, i % 3 == 0 ? Look{.kind = LookKind::metal} : Look{}));
    const VoxelSet set = set_of(voxels);
    const VoxelPalette palette(set, false);
    EXPECT_EQ(palette.entries().size(), 255u);
    EXPECT_EQ(palette.error().largest, 0.0);
    for (const ColouredVoxel& v : set.blocks[0].surface) {
        const PaletteEntry& entry = palette.entries()[palette.entry_of(v, {})];
        EXPECT_EQ(entry.colour, glm::u8vec3(v.r, v.g, v.b));
        EXPECT_EQ(packed(entry.look), v.look);
    }
}

TEST(VoxelPalette, materials_do_not_share_entries) {
    std::vector<ColouredVoxel> voxels = random_colours(3000);
    const Look glass{.kind = LookKind::glass, .level = 15, .ior = 5};
    for (const ColouredVoxel& v : random_colours(3000, glass))
        voxels.push_back(v);
    const VoxelSet set = set_of(voxels);
    const VoxelPalette palette(set, false);
    EXPECT_EQ(palette.entries().size(), 255u);
    for (const VoxelBlock& block : set.blocks) {
        for (const ColouredVoxel& v : block.surface)
            EXPECT_EQ(packed(palette.entries()[palette.entry_of(v, {})].look), v.look);
    }
}

TEST(VoxelPalette, too_many_looks_are_rounded_until_they_fit) {
    std::vector<ColouredVoxel> voxels;
    for (int i = 0; i < 4000; ++i) {
        const Look look{.kind = i % 2 == 0 ? LookKind::glass : LookKind::emit,
                        .rough = static_cast<std::uint8_t>(i % 2 == 0 ? i / 2 % 8 : 0),
                        .level = static_cast<std::uint8_t>(i / 16 % 16)};
        voxels.push_back(coloured(i % 256, i / 256, 7, look));
    }
    const VoxelPalette palette(set_of(voxels), false);
    std::set<Look> looks;
    for (const PaletteEntry& entry : palette.entries())
        looks.insert(entry.look);
    EXPECT_LE(looks.size(), 24u);
    EXPECT_EQ(looks.begin()->kind, LookKind::glass);
    EXPECT_EQ(looks.rbegin()->kind, LookKind::emit);
}

TEST(VoxelPalette, very_common_colour_is_kept_to_the_bit) {
    std::vector<ColouredVoxel> voxels = random_colours(4000);
    for (int i = 0; i < 2000; ++i)
        voxels.push_back(coloured(253, 216, i % 4 == 0 ? 2 : 1));
    const VoxelPalette palette(set_of(voxels), false);
    const auto entry = palette.entries()[palette.entry_of(coloured(253, 216, 1), {})];
    EXPECT_EQ(entry.colour, glm::u8vec3(253, 216, 1));
}

TEST(VoxelPalette, dithered_means_are_nearer_than_single_entries) {
    std::vector<ColouredVoxel> voxels = random_colours(20000);
    const VoxelSet set = set_of(voxels);
    double plain_error = 0.0, dithered_error = 0.0;
    const VoxelPalette plain(set, false);
    const VoxelPalette dithered(set, true);
    for (std::size_t i = 0; i < 100; ++i) {
        const ColouredVoxel& v = set.blocks[0].surface[i];
        glm::vec3 mean(0.0f);
        for (int k = 0; k < 512; ++k)
            mean += oklab_of(dithered.entries()[dithered.entry_of(v, {k % 8, k / 8 % 8, k / 64})].colour) /
                    512.0f;
        const glm::vec3 wanted = oklab_of(glm::u8vec3(v.r, v.g, v.b));
        dithered_error += static_cast<double>(glm::distance(mean, wanted));
        plain_error += static_cast<double>(
            glm::distance(oklab_of(plain.entries()[plain.entry_of(v, {})].colour), wanted));
    }
    EXPECT_LT(dithered_error, 0.8 * plain_error);
}

TEST(WholeSection, is_what_cutting_gives) {
    const SectionTable table;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> at(-1.0f, 1.0f);
    float worst = 0.0f;
    double mean = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 n = glm::normalize(glm::vec3(at(random), at(random), at(random)));
        const glm::vec3 u = glm::normalize(glm::cross(n, glm::vec3(0.3f, 0.5f, 0.8f)));
        const glm::vec3 p(8.5f + 0.4f * at(random), 8.5f + 0.4f * at(random), 8.5f + 0.4f * at(random));
        const std::array<glm::vec3, 3> triangle = {p + 7.0f * u, p + 7.0f * glm::cross(n, u) - 4.0f * u,
                                                   p - 7.0f * glm::cross(n, u) - 4.0f * u};
        const auto whole = PlaneSections(table, triangle).at({8, 8, 8});
        PieceCutter cutter(triangle);
        cutter.begin_row(8, 8);
        const CellPiece cut = cutter.next_cell(8);
        ASSERT_TRUE(whole.has_value());
        EXPECT_NEAR(whole->area, cut.area, 0.2f);
        worst = std::max(worst, glm::distance(whole->centre, cut.centre));
        mean += static_cast<double>(glm::distance(whole->centre, cut.centre)) / 2000.0;
    }
    EXPECT_LT(worst, 0.1f);
    EXPECT_LT(mean, 0.01);
    EXPECT_GT(mean, 1e-6);
}

// A triangle cut into its cells keeps its area and its moments.
TEST(CellPiece, areas_and_moments_add_up) {
    const std::array<glm::vec3, 3> triangle = {{{0.3f, 0.2f, 0.4f}, {9.1f, 2.2f, 1.7f}, {2.6f, 7.3f, 5.9f}}};
    PieceCutter cutter(triangle);
    double area = 0.0;
    glm::dvec3 moment(0.0);
    for (int z = 0; z < 7; ++z) {
        for (int y = 0; y < 9; ++y) {
            cutter.begin_row(y, z);
            for (int x = 0; x < 10; ++x) {
                const CellPiece piece = cutter.next_cell(x);
                area += static_cast<double>(piece.area);
                moment += glm::dvec3(piece.centre) * static_cast<double>(piece.area);
            }
        }
    }
    EXPECT_NEAR(area, static_cast<double>(cutter.area()), 1e-3);
    EXPECT_LT(glm::distance(moment / area, glm::dvec3((triangle[0] + triangle[1] + triangle[2]) / 3.0f)),
              1e-3);
}

using ColouredCell = std::tuple<int, int, int>;

// The cells of a file by the scene's rule, with their palette index.
std::map<ColouredCell, int> cells_in(const VoxFile& file) {
    std::map<ColouredCell, int> cells;
    const auto instances = vox_instances(file);
    EXPECT_TRUE(instances.ok());
    for (const VoxInstance& at : instances.value()) {
        const VoxModel& model = file.models[at.model];
        for (const VoxVoxel& v : model.voxels) {
            const glm::ivec3 c = glm::ivec3(v.x, v.y, v.z) - model.size / 2 + at.translation;
            EXPECT_TRUE(cells.emplace(ColouredCell{c.x, c.y, c.z}, v.index).second);
        }
    }
    return cells;
}

TEST(VoxOutput, file_holds_the_voxels_in_tight_models_around_the_origin) {
    const Mesh mesh = test::torus(1.0, 0.08, 37, 7);
    const VoxelSet set = voxelize_mesh(mesh, {.grid = {.resolution = 260, .up = UpAxis::z}});
    const VoxelPalette palette(set, false);
    const ScratchFolder folder;
    const VoxOutput output = write_voxels(folder / "a.vox", set, palette, mesh, "ring");
    const std::vector<std::byte> bytes = read_file(folder / "a.vox");
    EXPECT_EQ(output.bytes, bytes.size());
    const VoxFile file = read_vox(bytes).value_or_throw(ExitCode::internal);
    EXPECT_TRUE(file.warnings.empty());
    EXPECT_TRUE(file.has_palette);
    EXPECT_EQ(file.models.size(), output.models);
    EXPECT_EQ(file.materials.size(), palette.entries().size());
    EXPECT_EQ(write_vox(file).size(), bytes.size());
    for (const VoxModel& model : file.models) {
        glm::ivec3 low(256), high(-1);
        for (const VoxVoxel& v : model.voxels) {
            low = glm::min(low, glm::ivec3(v.x, v.y, v.z));
            high = glm::max(high, glm::ivec3(v.x, v.y, v.z));
        }
        EXPECT_EQ(low, glm::ivec3(0));
        EXPECT_EQ(high + 1, model.size);
    }
    const glm::ivec3 to_grid = set.grid.cells / 2;
    std::size_t found = 0;
    const std::map<ColouredCell, int> cells = cells_in(file);
    for (const VoxelBlock& block : set.blocks) {
        for (const ColouredVoxel& v : block.surface) {
            const glm::ivec3 c = block.low / kModelCells * kModelCells + glm::ivec3(v.x, v.y, v.z) - to_grid;
            found += cells.contains(ColouredCell{c.x, c.y, c.z}) ? 1 : 0;
        }
    }
    EXPECT_EQ(found, set.surface);
    EXPECT_EQ(cells.size(), set.surface);
}

TEST(VoxOutput, grid_of_256_is_one_model_and_257_at_most_eight) {
    const ScratchFolder folder;
    const Mesh mesh = test::cube({0, 0, 0}, {1, 1, 1});
    for (const int resolution : {256, 257}) {
        const VoxelSet set = voxelize_mesh(mesh, {.grid = {.resolution = resolution}});
        EXPECT_EQ(write_voxels(folder / "a.vox", set, VoxelPalette(set, false), mesh, "cube").models,
                  resolution == 256 ? 1u : 8u);
    }
}

TEST(VoxOutput, materials_read_back_as_they_were_meant) {
    std::vector<ColouredVoxel> voxels = {
        coloured(200, 100, 50, {.kind = LookKind::metal, .rough = 7}),
        coloured(10, 20, 30, {.kind = LookKind::glass, .level = 15, .ior = 5}),
        coloured(90, 90, 90, {.kind = LookKind::emit, .level = 15}), coloured(1, 2, 3)};
    const VoxelSet set = set_of(voxels);
    const VoxelPalette palette(set, false);
    const ScratchFolder folder;
    write_voxels(folder / "a.vox", set, palette, Mesh{}, "a");
    const VoxFile file = load_vox(folder / "a.vox");
    std::vector<std::string> warnings;
    const auto materials = vox_materials(file, warnings);
    EXPECT_TRUE(warnings.empty());
    const auto at = [&](const ColouredVoxel& v) {
        return materials[palette.entry_of(v, {}) + std::size_t{1}];
    };
    EXPECT_EQ(at(voxels[0]).surface, Surface::metal);
    EXPECT_EQ(at(voxels[0]).roughness, 1.0f);
    EXPECT_EQ(at(voxels[1]).surface, Surface::glass);
    EXPECT_EQ(at(voxels[1]).transmission, 1.0f);
    EXPECT_EQ(at(voxels[1]).ior, 1.5f);
    EXPECT_EQ(at(voxels[2]).surface, Surface::emit);
    EXPECT_NEAR(at(voxels[2]).emission.g / at(voxels[2]).albedo.g, 8.0f, 0.01f);
    EXPECT_EQ(at(voxels[3]).surface, Surface::diffuse);
}

// A camera at the grid's front edge that looks along the mesh's -z is one that looks along +y in the file.
TEST(VoxOutput, camera_looks_where_the_mesh_one_does) {
    Mesh mesh = test::cube({-1, -1, -1}, {1, 1, 1});
    mesh.cameras.push_back({.position = {0, 0, 5}, .forward = {0, 0, -1}, .fov_y_deg = 40.0});
    mesh.cameras.push_back({.position = {-5, 0, 0}, .forward = {1, 0, 0}});
    const VoxelSet set = voxelize_mesh(mesh, {.grid = {.resolution = 10}});
    const ScratchFolder folder;
    write_voxels(folder / "a.vox", set, VoxelPalette(set, false), mesh, "a");
    const VoxFile file = load_vox(folder / "a.vox");
    ASSERT_EQ(file.cameras.size(), 2u);
    EXPECT_EQ(*find_value(file.cameras[0].attributes, "_angle"), "0 0 0");
    EXPECT_EQ(*find_value(file.cameras[0].attributes, "_focus"), "0 0 0");
    EXPECT_EQ(*find_value(file.cameras[0].attributes, "_radius"), "25");
    EXPECT_EQ(*find_value(file.cameras[0].attributes, "_fov"), "40");
    EXPECT_EQ(*find_value(file.cameras[1].attributes, "_angle"), "0 -90 0");
}

TEST(VoxOutput, full_disk_leaves_no_file) {
    const VoxelSet set = set_of({coloured(1, 2, 3)});
    EXPECT_THROW(write_voxels("/dev/full", set, VoxelPalette(set, false), Mesh{}, "a"), Error);
}

}  // namespace
}  // namespace voxilux
