// voxilux convert as a user runs it, and inputs that are converted to voxels before they are rendered.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "formats/vox_read.h"
#include "scene/vox_instances.h"
#include "support/mesh_file_builder.h"
#include "support/scratch_folder.h"
#include "support/voxel_file_builder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

using voxel_file_builder::Cells;
using voxel_file_builder::Sample;

std::string written(const ScratchFolder& folder, const std::string& name, const std::string& bytes) {
    const std::string path = (folder / name).string();
    std::FILE* file = std::fopen(path.c_str(), "wb");
    EXPECT_NE(file, nullptr);
    EXPECT_EQ(std::fwrite(bytes.data(), 1, bytes.size(), file), bytes.size());
    std::fclose(file);
    return path;
}

// The cells of a .vox file and their colours.
Cells cells_of_vox(const std::string& path) {
    const VoxFile file = load_vox(path);
    const auto instances = vox_instances(file);
    EXPECT_TRUE(instances);
    Cells cells;
    for (const VoxInstance& instance : instances.value()) {
        const VoxModel& model = file.models[instance.model];
        for (const VoxVoxel& voxel : model.voxels) {
            const VoxColour colour = colour_of(file, voxel.index);
            cells[world_cell({.rotation = instance.rotation, .translation = instance.translation}, model.size,
                             {voxel.x, voxel.y, voxel.z})] = {colour.r, colour.g, colour.b};
        }
    }
    return cells;
}

constexpr const char* kTetrahedronMesh =
    "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1 1 1 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(Convert, each_voxel_format_becomes_the_same_cells) {
    const ScratchFolder folder;
    for (const auto& [ending, make] : voxel_file_builder::kSampledFormats) {
        const Sample sample = make(0);
        const std::string input = written(folder, std::string("a") + ending, sample.bytes);
        const std::string output = (folder / "a.vox").string();
        const Ending end = run({"convert", input, output});
        EXPECT_EQ(end.code, 0) << end.err;
        EXPECT_EQ(end.err.find("note: " + input + ": "), 0u) << end.err;
        EXPECT_EQ(end.err.find("dE76"), std::string::npos) << end.err;
        EXPECT_TRUE(cells_of_vox(output) == sample.expected) << ending;
        EXPECT_EQ(run({"info", input}).out, run({"info", output}).out);
    }
}

// Matrices of one voxel in many models of 256^3 cells, each place twice.
TEST(Convert, cells_far_apart_and_twice_named_keep_their_places) {
    const ScratchFolder folder;
    Cells expected;
    std::string bytes = voxel_file_builder::qb_header(false, false, true, 200);
    for (int i = 0; i < 200; ++i) {
        const glm::ivec3 at((i % 100) * 37 - 2000, (i % 100) * 11, -(i % 7) * 150);
        const glm::u8vec3 colour(i, 1, 2);
        bytes += voxel_file_builder::qb_matrix({{{0, 0, 0}, colour}}, {1, 1, 1}, at, false, true);
        expected[{at.x, at.z, at.y}] = colour;
    }
    const std::string input = written(folder, "a.qb", bytes), output = (folder / "a.vox").string();
    EXPECT_EQ(run({"convert", input, output, "-q"}).code, 0);
    EXPECT_TRUE(cells_of_vox(output) == expected);
}

TEST(Convert, vox_file_stays_the_same_but_for_the_order_of_its_chunks) {
    const ScratchFolder folder;
    const std::string input = written(folder, "a.vox", vox_builder::rich_file_text());
    const std::string once = (folder / "b.vox").string(), twice = (folder / "c.vox").string();
    EXPECT_EQ(run({"convert", input, once}).code, 0);
    EXPECT_EQ(run({"convert", once, twice}).code, 0);
    EXPECT_EQ(bytes_of(once), bytes_of(twice));
    VoxFile before = load_vox(input), after = load_vox(once);
    before.warnings = after.warnings = {};  // they name bytes
    EXPECT_TRUE(before == after);
}

TEST(Convert, mesh_on_the_way_to_a_picture_is_the_voxelized_mesh) {
    const ScratchFolder folder;
    const std::string mesh = written(folder, "mesh.obj", kTetrahedronMesh);
    const std::string vox = (folder / "mesh.vox").string();
    ASSERT_EQ(run({"voxelize", mesh, "-o", vox, "--resolution", "24", "-q"}).code, 0);
    for (const std::string& input : {mesh, vox}) {
        const Ending end = run(
            {"render", input, "-o", input + ".exr", "--size", "48x36", "--spp", "1", "--resolution", "24"});
        EXPECT_EQ(end.code, 0) << end.err;
        EXPECT_EQ(end.err.find("4 triangles voxelized (--resolution 24)") != std::string::npos, input == mesh)
            << end.err;
    }
    const Json difference = json_of({"compare", vox + ".exr", mesh + ".exr", "--json", "-"});
    EXPECT_EQ(difference["max_abs"], 0.0);
    const std::string coarse = mesh + ".coarse.exr";
    ASSERT_EQ(
        run({"render", mesh, "-o", coarse, "--size", "48x36", "--spp", "1", "--resolution", "12", "-q"}).code,
        0);
    EXPECT_GT(json_of({"compare", vox + ".exr", coarse, "--json", "-"})["max_abs"], 0.0);
    EXPECT_EQ(run({"convert", mesh, (folder / "c.vox").string(), "--resolution", "24"}).code, 0);
    EXPECT_EQ(bytes_of(folder / "c.vox"), bytes_of(vox));
    EXPECT_EQ(run({"plan", mesh}).code, 0);
}

TEST(Convert, broken_files_are_one_line_and_leave_nothing) {
    const ScratchFolder folder;
    for (const auto& [ending, make] : voxel_file_builder::kSampledFormats) {
        const std::string bytes = make(1).bytes;
        const std::string input =
            written(folder, std::string("a") + ending, bytes.substr(0, bytes.size() / 2));
        for (const Words& words : {Words{"convert", input, (folder / "a.vox").string()},
                                   Words{"render", input, "-o", (folder / "a.png").string()}}) {
            const Ending end = run(words);
            EXPECT_EQ(end.code, 3);
            EXPECT_EQ(end.err.find("voxilux: " + input + ": at byte "), 0u) << end.err;
            EXPECT_EQ(std::ranges::count(end.err, '\n'), 1) << end.err;
        }
        std::filesystem::remove(input);
    }
    EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(Convert, each_mesh_and_cloud_becomes_voxels) {
    const ScratchFolder folder;
    const mesh_file_builder::PlainMesh mesh = mesh_file_builder::random_mesh(8);
    using mesh_file_builder::PlyWriting;
    const std::pair<const char*, std::string> files[] = {
        {"a.stl", mesh_file_builder::stl_binary(mesh)},
        {"b.stl", mesh_file_builder::stl_text(mesh)},
        {"a.ply", mesh_file_builder::ply(mesh, PlyWriting::big_endian)},
        {"b.ply", mesh_file_builder::ply_points(mesh, PlyWriting::text)},
        {"a.xyz", mesh_file_builder::xyz(mesh)},
        {"a.las", mesh_file_builder::las(mesh, 7, 14)},
    };
    std::map<std::string, Cells> cells;
    for (const auto& [name, bytes] : files) {
        const std::string input = written(folder, name, bytes), output = (folder / "a.vox").string();
        const Ending end = run({"convert", input, output, "--resolution", "40"});
        EXPECT_EQ(end.code, 0) << end.err;
        EXPECT_NE(end.err.find("(--resolution 40)"), std::string::npos) << end.err;
        cells[name] = cells_of_vox(output);
    }
    EXPECT_EQ(cells["a.stl"], cells["b.stl"]);
    EXPECT_EQ(cells["b.ply"], cells["a.xyz"]);
    EXPECT_EQ(cells["a.las"], cells["a.xyz"]);
    EXPECT_LE(cells["a.xyz"].size(), mesh.positions.size());
    EXPECT_GT(cells["a.ply"].size(), 100u);
    EXPECT_EQ(run({"voxelize", (folder / "a.xyz").string(), "-o", (folder / "b.vox").string()}).code, 3);
}

TEST(Convert, mesh_of_voxels_is_read_as_a_mesh) {
    const ScratchFolder folder;
    const Sample sample = voxel_file_builder::qb_sample(1);
    const std::string input = written(folder, "a.qb", sample.bytes), mesh = (folder / "a.glb").string();
    const Ending end = run({"convert", input, mesh});
    EXPECT_EQ(end.code, 0) << end.err;
    EXPECT_NE(end.err.find("rectangles"), std::string::npos) << end.err;
    EXPECT_EQ(run({"convert", mesh, (folder / "b.vox").string(), "--resolution", "30", "-q"}).code, 0);
}

TEST(Convert, standard_streams_hold_vox_files_and_scenes) {
    const ScratchFolder folder;
    const std::string input = written(folder, "a.vox", vox_builder::rich_file_text());
    const std::string direct = (folder / "b.vox").string(), piped = (folder / "c.vox").string();
    ASSERT_EQ(run({"convert", input, direct}).code, 0);
    const auto shell = [&](const std::string& command) {
        return std::system(("cd '" + folder.path().string() + "' && " + command + " 2>err").c_str());
    };
    EXPECT_EQ(shell("'" VX_BINARY "' convert - - < a.vox > c.vox"), 0);
    EXPECT_EQ(bytes_of(piped), bytes_of(direct));
    EXPECT_EQ(
        shell("'" VX_BINARY "' plan - < a.vox > plan_piped && '" VX_BINARY "' plan a.vox > plan_direct"), 0);
    EXPECT_EQ(bytes_of(folder / "plan_piped"), bytes_of(folder / "plan_direct"));
    EXPECT_EQ(shell("printf '[[model]]\\nfile = \"a.vox\"\\n' | '" VX_BINARY "' plan - > plan_scene"), 0);
    EXPECT_NE(shell("printf 'nonsense' | '" VX_BINARY "' plan -"), 0);
    EXPECT_EQ(bytes_of(folder / "err").find("voxilux: standard input:1:"), 0u) << bytes_of(folder / "err");
    EXPECT_EQ(WEXITSTATUS(shell("'" VX_BINARY "' plan - < /dev/null")), 3);
    EXPECT_EQ(bytes_of(folder / "err"), "voxilux: standard input is empty\n");
    EXPECT_NE(shell("printf 'VOX x' | '" VX_BINARY "' convert - x.vox"), 0);
    EXPECT_EQ(bytes_of(folder / "err").find("voxilux: standard input: at byte "), 0u);
}

TEST(Convert, outputs_that_cannot_be_are_refused) {
    const ScratchFolder folder;
    const std::string input = written(folder, "a.vox", vox_builder::rich_file_text());
    EXPECT_EQ(run({"convert", input, (folder / "a.qb").string()}).code, 2);
    EXPECT_EQ(run({"convert", input, input}).code, 2);
    EXPECT_EQ(run({"convert", input}).code, 2);
    EXPECT_EQ(run({"convert", input, (folder / "no/a.vox").string()}).code, 73);
}

}  // namespace
}  // namespace voxilux::test
