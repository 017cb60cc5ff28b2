// Voxels as meshes for game engines: every exposed face once, and the same cells when they are voxelized
// again.

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "formats/vox_read.h"
#include "support/vox_builder.h"
#include "voxelizer/glb_output.h"
#include "voxelizer/greedy_mesh.h"
#include "voxelizer/load_gltf.h"
#include "voxelizer/voxelize_mesh.h"

namespace voxilux {
namespace {

using UnitFace = std::array<int, 6>;  // cell behind it, axis, whether it looks up, index
using CellColours = std::map<std::array<int, 3>, glm::u8vec3>;

constexpr std::array<bool, 256> kNoneClear{};
constexpr std::size_t kManyQuads = 10000;

std::vector<IndexedCell> random_indexed(glm::ivec3 size, std::uint32_t seed, int indices,
                                        unsigned share_of_8) {
    std::mt19937 random(seed);
    std::vector<IndexedCell> cells;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                if (random() % 8 < share_of_8)
                    cells.push_back(
                        {{x - 3, y, z - 70},
                         static_cast<std::uint8_t>(1 + random() % static_cast<unsigned>(indices))});
    return cells;
}

std::multiset<UnitFace> unit_faces(const std::vector<VoxelQuad>& quads) {
    std::multiset<UnitFace> faces;
    for (const VoxelQuad& quad : quads)
        for (int i = 0; i < quad.size.x; ++i)
            for (int j = 0; j < quad.size.y; ++j) {
                glm::ivec3 cell = quad.low;
                cell[(quad.axis + 1) % 3] += i;
                cell[(quad.axis + 2) % 3] += j;
                if (quad.is_positive) --cell[quad.axis];
                faces.insert({cell.x, cell.y, cell.z, quad.axis, quad.is_positive, quad.index});
            }
    return faces;
}

std::multiset<UnitFace> exposed_faces(const std::vector<IndexedCell>& cells,
                                      const std::array<bool, 256>& is_clear) {
    std::map<std::array<int, 3>, std::uint8_t> by_place;
    for (const IndexedCell& c : cells)
        by_place[{c.cell.x, c.cell.y, c.cell.z}] = c.index;
    std::multiset<UnitFace> faces;
    for (const IndexedCell& c : cells)
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                glm::ivec3 n = c.cell;
                n[axis] += step;
                const auto found = by_place.find({n.x, n.y, n.z});
                if (found == by_place.end() || (is_clear[found->second] && !is_clear[c.index]))
                    faces.insert({c.cell.x, c.cell.y, c.cell.z, axis, step > 0, c.index});
            }
    return faces;
}

TEST(GreedyMesh, covers_every_exposed_face_once) {
    std::array<bool, 256> is_clear{};
    is_clear[2] = true;
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        const auto cells = random_indexed({7, 5, 6}, seed, 3, 1 + seed % 7);
        for (const auto& clear : {kNoneClear, is_clear})
            EXPECT_EQ(unit_faces(greedy_quads(cells, clear, kManyQuads)), exposed_faces(cells, clear))
                << seed;
    }
}

TEST(GreedyMesh, box_has_six_quads_and_one_that_misses_a_corner_has_more) {
    std::vector<IndexedCell> box = random_indexed({9, 4, 5}, 1, 1, 8);
    ASSERT_EQ(box.size(), 180u);
    EXPECT_EQ(greedy_quads(box, kNoneClear, kManyQuads).size(), 6u);
    box.pop_back();
    EXPECT_EQ(greedy_quads(box, kNoneClear, kManyQuads).size(), 6u + 6u);
}

TEST(GreedyMesh, more_quads_than_a_file_holds_are_refused) {
    const std::vector<IndexedCell> box = random_indexed({9, 4, 5}, 1, 1, 8);
    EXPECT_EQ(greedy_quads(box, kNoneClear, 6).size(), 6u);
    try {
        (void)greedy_quads(box, kNoneClear, 5);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
    }
}

// The quads of the .glb file moved a quarter of a voxel inwards, so that each lies inside the cells that it
// belongs to; a quad is four vertices and two triangles. The moved corners of the box keep the grid in place.
Mesh moved_inwards(const Mesh& mesh) {
    Mesh moved = mesh;
    glm::dvec3 low(1e9), high(-1e9);
    for (const glm::dvec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 2) {
        const glm::uvec3 v = mesh.triangles[i].vertices;
        const glm::dvec3 normal = glm::normalize(
            glm::cross(mesh.positions[v.y] - mesh.positions[v.x], mesh.positions[v.z] - mesh.positions[v.x]));
        for (std::uint32_t k = 0; k < 4; ++k)
            moved.positions[v.x + k] -= 0.25 * normal;
    }
    for (const glm::dvec3& corner : {low, high}) {
        const auto vertex = static_cast<std::uint32_t>(moved.positions.size());
        moved.positions.push_back(corner);
        moved.uv0.emplace_back(0.0f);
        moved.triangles.push_back({glm::uvec3(vertex), 0});
    }
    return moved;
}

CellColours voxelized(const std::vector<std::byte>& glb) {
    MeshNotes notes;
    const Mesh mesh = load_gltf(glb, "", {}, notes);
    EXPECT_TRUE(notes.empty()) << notes.begin()->first;
    const VoxelSet set = voxelize_mesh(
        moved_inwards(mesh), {.grid = {.metres_per_voxel = 1.0}, .coverage = Coverage::thin, .threads = 1});
    CellColours cells;
    for (const VoxelBlock& block : set.blocks)
        for (const ColouredVoxel& v : block.surface) {
            const glm::ivec3 cell = block.low / 256 * 256 + glm::ivec3(v.x, v.y, v.z);
            cells[{cell.x, cell.y, cell.z}] = {v.r, v.g, v.b};
        }
    return cells;
}

// Cells whose colour differs, or that one of the two lacks.
std::vector<std::array<int, 3>> different(const CellColours& a, const CellColours& b) {
    std::vector<std::array<int, 3>> cells;
    for (const auto& [cell, colour] : a)
        if (!b.contains(cell) || b.at(cell) != colour) cells.push_back(cell);
    for (const auto& [cell, colour] : b)
        if (!a.contains(cell)) cells.push_back(cell);
    return cells;
}

VoxFile file_of(const std::vector<IndexedCell>& cells, glm::ivec3 size) {
    VoxFile file;
    VoxModel model{.size = size};
    for (const IndexedCell& c : cells) {
        const glm::u8vec3 at(c.cell - glm::ivec3(-3, 0, -70));
        model.voxels.push_back({at.x, at.y, at.z, c.index});
    }
    file.models.push_back(model);
    return file;
}

// Cells with an exposed face, relative to their common low corner.
CellColours surface_of(const VoxFile& file) {
    CellColours cells;
    const std::vector<IndexedCell> all = cells_of_file(file);
    glm::ivec3 low(1 << 20);
    for (const IndexedCell& c : all)
        low = glm::min(low, c.cell);
    std::set<std::array<int, 3>> seen;
    for (const UnitFace& face : exposed_faces(all, kNoneClear))
        seen.insert({face[0], face[1], face[2]});
    for (const IndexedCell& c : all) {
        if (!seen.contains({c.cell.x, c.cell.y, c.cell.z})) continue;
        const VoxColour colour = colour_of(file, c.index);
        const glm::ivec3 at = c.cell - low;
        cells[{at.x, at.y, at.z}] = {colour.r, colour.g, colour.b};
    }
    return cells;
}

TEST(GlbOutput, voxelized_again_it_has_the_same_cells_and_colours) {
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        const glm::ivec3 size(6 + seed, 5, 9);
        const VoxFile file = file_of(random_indexed(size, seed, 200, 1 + seed % 7), size);
        const CellColours expected = surface_of(file);
        EXPECT_EQ(different(voxelized(glb_of(file).bytes), expected), (std::vector<std::array<int, 3>>{}))
            << seed;
        VoxFile changed = file;
        changed.models[0].voxels[0].index ^= 1;
        EXPECT_FALSE(different(voxelized(glb_of(changed).bytes), expected).empty()) << "it sees a colour";
    }
}

TEST(GlbOutput, instances_overlap_hide_and_turn_as_in_a_picture) {
    const auto file = read_vox(vox_builder::bytes_of(vox_builder::rich_file_text()));
    ASSERT_TRUE(file);
    const CellColours expected = surface_of(file.value());
    ASSERT_FALSE(expected.empty());
    EXPECT_EQ(voxelized(glb_of(file.value()).bytes).size(), expected.size());
}

TEST(GlbOutput, looks_come_back) {
    VoxFile file =
        file_of({{{-3, 0, -70}, 1}, {{-1, 0, -70}, 2}, {{1, 0, -70}, 3}, {{3, 0, -70}, 4}}, {7, 1, 1});
    file.materials = {{2, {{"_type", "_metal"}, {"_metal", "1"}, {"_rough", "0.25"}}},
                      {3, {{"_type", "_glass"}, {"_trans", "0.75"}, {"_ri", "1.4"}}},
                      {4, {{"_type", "_emit"}, {"_emit", "0.5"}, {"_flux", "3"}}}};
    MeshNotes notes;
    const Mesh mesh = load_gltf(glb_of(file).bytes, "", {}, notes);
    ASSERT_EQ(mesh.materials.size(), 4u);
    std::set<std::string> seen;
    for (const MeshMaterial& m : mesh.materials) {
        if (m.metallic == 1.0f)
            seen.insert(m.roughness == 0.25f ? "metal" : "?");
        else if (m.transmission > 0.0f)
            seen.insert(m.transmission == 0.75f && m.ior == 1.4f && m.alpha_mode == AlphaMode::opaque
                            ? "glass"
                            : "?");
        else if (m.emissive.r > 0.0f)
            seen.insert(std::abs(m.emissive.r - 4.0f) < 1e-5f ? "emit" : "?");
        else
            seen.insert(m.roughness == 1.0f ? "diffuse" : "?");
    }
    EXPECT_EQ(seen, (std::set<std::string>{"diffuse", "emit", "glass", "metal"}));
    const std::vector<std::byte> glb = glb_of(file).bytes;
    const std::string_view text(reinterpret_cast<const char*>(glb.data()), glb.size());
    const std::string_view used = text.substr(text.find("extensionsUsed"));
    EXPECT_NE(used.substr(0, used.find(']')).find("KHR_materials_transmission"), std::string_view::npos);
}

TEST(GlbOutput, file_without_a_visible_voxel_is_refused) {
    EXPECT_THROW((void)glb_of(file_of({}, {1, 1, 1})), Error);
}

}  // namespace
}  // namespace voxilux
