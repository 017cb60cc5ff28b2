// voxilux voxelize as a user runs it, and its files against the independent oracles of the shared data.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "support/scratch_folder.h"
#include "support/shared_data.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string mesh_file(const ScratchFolder& folder, const std::string& text = kTetrahedron) {
    const std::string name = (folder / "mesh.obj").string();
    std::FILE* file = std::fopen(name.c_str(), "wb");
    EXPECT_NE(file, nullptr);
    std::fputs(text.c_str(), file);
    std::fclose(file);
    return name;
}

std::string output_of(const std::string& command) {
    std::string text;
    std::FILE* pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return text;
    std::array<char, 256> part;
    while (std::fgets(part.data(), part.size(), pipe) != nullptr)
        text += part.data();
    return ::pclose(pipe) == 0 ? text : "";
}

bool has_numpy() {
    return !output_of(VX_PYTHON " -c 'import numpy, PIL; print(1)' 2>/dev/null").empty();
}

#define SKIP_WITHOUT_ORACLE()   \
    SKIP_WITHOUT_SHARED_DATA(); \
    if (!has_numpy()) GTEST_SKIP() << VX_PYTHON " lacks numpy or Pillow"

// Voxelizes a mesh of the shared data and asks the oracle.
Json checked(const std::string& mesh, int resolution, const std::string& checker_flags = "",
             std::vector<std::string> flags = {}) {
    const ScratchFolder folder;
    const std::string input = (shared_data() / "data/meshes" / mesh).string();
    const std::string output = (folder / "a.vox").string();
    flags.insert(flags.begin(),
                 {"voxelize", input, "-o", output, "--resolution", std::to_string(resolution)});
    const Ending ending = run(flags);
    EXPECT_EQ(ending.code, 0) << ending.err;
    const std::string text =
        output_of(VX_PYTHON " '" VX_SOURCE_DIR "/tests/tools/cli/voxelize_checker.py' '" +
                  (shared_data() / "oracle").string() + "' '" + input + "' '" + output + "' " +
                  std::to_string(resolution) + " " + checker_flags);
    return text.empty() ? Json() : Json::parse(text);
}

void expect_exact(const Json& json) {
    ASSERT_TRUE(json.is_object());
    EXPECT_GT(json["have"], 0);
    EXPECT_EQ(json["missing"], 0) << json;
    EXPECT_EQ(json["extra"], 0) << json;
    EXPECT_EQ(json["outside"], 0) << json;
    EXPECT_EQ(json["holes"], 0) << json;
}

class VoxelizeExternal : public testing::TestWithParam<std::string> {};

TEST_P(VoxelizeExternal, voxels_are_those_of_the_oracle_at_32_and_64) {
    SKIP_WITHOUT_ORACLE();
    for (const int resolution : {32, 64})
        expect_exact(checked(GetParam(), resolution, "", {"--ignore-mask"}));
}

// The oracle takes minutes for larger ones, which are checked at night.
INSTANTIATE_TEST_SUITE_P(meshes, VoxelizeExternal,
                         testing::Values("AlphaBlendModeTest.glb", "BoxInterleaved.glb",
                                         "BoxVertexColors.glb", "CubeImageUriSpaces/CubeImageUriSpaces.gltf",
                                         "Mesh_PrimitiveMode_04/Mesh_PrimitiveMode_04.gltf",
                                         "Mesh_PrimitiveMode_12/Mesh_PrimitiveMode_12.gltf",
                                         "TextureTransformTest/TextureTransformTest.gltf",
                                         "box_sparse/box_sparse.gltf", "cornell-box.glb",
                                         "cube-vertexcol.obj",
                                         "subpass_scene_transparent/subpass_scene_transparent.gltf"));

TEST(VoxelizeOracleExternalNightly, thin_surface_lacks_voxels_of_the_oracle) {
    SKIP_WITHOUT_ORACLE();
    EXPECT_GT(checked("Duck.glb", 32, "", {"--thin"})["missing"], 100);
}

TEST(VoxelizeOracleExternalNightly, another_resolution_is_seen) {
    SKIP_WITHOUT_ORACLE();
    const Json json = checked("Duck.glb", 32, "", {"--up", "-y"});
    EXPECT_GT(json["missing"].get<int>() + json["outside"].get<int>(), 100);
}

class VoxelizeExternalNightly : public testing::TestWithParam<std::string> {};

TEST_P(VoxelizeExternalNightly, voxels_are_those_of_the_oracle_at_32_64_and_256) {
    SKIP_WITHOUT_ORACLE();
    for (const int resolution : {32, 64, 256})
        expect_exact(checked(GetParam(), resolution));
}

INSTANTIATE_TEST_SUITE_P(meshes, VoxelizeExternalNightly,
                         testing::Values("Duck.glb", "balloon/scene.gltf", "FlightHelmet/FlightHelmet.gltf",
                                         "Sponza_LowPoly/Sponza_LowPoly.gltf", "stanford-bunny.obj"));

TEST(VoxelizeColourExternalNightly, colours_are_near_the_mean_by_area) {
    SKIP_WITHOUT_ORACLE();
    const Json duck = checked("Duck.glb", 256, "--color");
    EXPECT_LE(duck["dE_p95"], 0.2);
    const Json helmet = checked("FlightHelmet/FlightHelmet.gltf", 256, "--color");
    EXPECT_LE(helmet["dE_median"], 2.4);
    EXPECT_LE(helmet["dE_p95"], 10.3);
}

TEST(Voxelize, report_has_what_scripts_need) {
    const ScratchFolder folder;
    const Ending ending = run({"voxelize", mesh_file(folder), "-o", (folder / "a.vox").string(),
                               "--resolution", "20", "--solid", "--json", "-"});
    ASSERT_EQ(ending.code, 0) << ending.err;
    const Json report = Json::parse(ending.out);
    EXPECT_EQ(report["command"], "voxelize");
    EXPECT_EQ(report["triangles"], 4);
    EXPECT_EQ(report["grid"]["cells"], Json({20, 20, 20}));
    EXPECT_EQ(report["voxels"].get<int>(), report["surface"].get<int>() + report["interior"].get<int>());
    EXPECT_EQ(report["solid"]["open_edges"], 0);
    EXPECT_EQ(report["models"], 1);
    EXPECT_EQ(report["palette"]["de76_max"], 0.0);
    for (const char* key : {"wall_s", "cpu_s", "peak_rss_mib", "bytes", "steps", "warnings"})
        EXPECT_TRUE(report.contains(key)) << key;
    const Ending info = run({"info", (folder / "a.vox").string(), "--json", "-"});
    EXPECT_EQ(Json::parse(info.out)["voxels"], report["voxels"]);
}

TEST(Voxelize, threads_do_not_change_the_file) {
    const ScratchFolder folder;
    const std::string mesh = mesh_file(folder);
    for (const char* threads : {"1", "2", "7"}) {
        ASSERT_EQ(run({"voxelize", mesh, "-o", (folder / (std::string(threads) + ".vox")).string(),
                       "--resolution", "300", "--threads", threads})
                      .code,
                  0);
    }
    EXPECT_EQ(bytes_of(folder / "1.vox"), bytes_of(folder / "2.vox"));
    EXPECT_EQ(bytes_of(folder / "1.vox"), bytes_of(folder / "7.vox"));
}

TEST(Voxelize, open_mesh_warns_and_is_refused_when_strict) {
    const ScratchFolder folder;
    const std::string mesh = mesh_file(folder, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string output = (folder / "a.vox").string();
    const Ending lenient = run({"voxelize", mesh, "-o", output, "--solid"});
    EXPECT_EQ(lenient.code, 0);
    EXPECT_NE(lenient.err.find("the mesh is open: 3 edges"), std::string::npos) << lenient.err;
    const Ending strict = run({"voxelize", mesh, "-o", (folder / "b.vox").string(), "--solid", "--strict"});
    EXPECT_EQ(strict.code, 3);
    EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"a.vox", "mesh.obj"}));
}

TEST(Voxelize, places_beyond_magicavoxel_warn_and_are_refused_when_strict) {
    const ScratchFolder folder;
    const std::string mesh = mesh_file(folder);
    const std::vector<std::string> words = {"voxelize",     mesh,   "-o",    (folder / "a.vox").string(),
                                            "--resolution", "1200", "--thin"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        return run(more);
    };
    EXPECT_EQ(with({"--strict"}).code, 0);
    const Ending lenient = with({"--floor"});
    EXPECT_EQ(lenient.code, 0);
    EXPECT_NE(lenient.err.find("from 0 to 1199 on z, beyond the -1000 to 999"), std::string::npos)
        << lenient.err;
    EXPECT_EQ(with({"--floor", "--strict"}).code, 3);
}

TEST(Voxelize, names_of_the_mesh_cannot_speak_to_the_terminal) {
    const ScratchFolder folder;
    const std::string mesh =
        mesh_file(folder, std::string(kTetrahedron) + "usemtl \x1b]0;pwned\x07 \xff\nf 1 2 3\n");
    const Ending ending =
        run({"voxelize", mesh, "-o", (folder / "a.vox").string(), "--resolution", "9", "--json", "-"});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_NE(ending.err.find("'\\x1b]0;pwned\\x07 \\xff'"), std::string::npos) << ending.err;
    for (const std::string& text : {ending.out, ending.err})
        EXPECT_EQ(text.find_first_of("\x1b\x07\xff"), std::string::npos);
    EXPECT_EQ(Json::parse(ending.out)["warnings"].size(), 1u);
}

TEST(Voxelize, bad_values_are_usage_errors) {
    const ScratchFolder folder;
    const std::string mesh = mesh_file(folder);
    const std::string output = (folder / "a.vox").string();
    for (const std::vector<std::string>& flags :
         std::vector<std::vector<std::string>>{{"--resolution", "0"},
                                               {"--resolution", "100000"},
                                               {"--scale", "0"},
                                               {"--scale", "nan"},
                                               {"--up", "w"},
                                               {"--turn", "45"},
                                               {"--progress", "loud"},
                                               {"--scale", "1", "--resolution", "9"},
                                               {"--parity", "--thin"},
                                               {"--scale", "1e-12"}}) {
        std::vector<std::string> words = {"voxelize", mesh, "-o", output};
        words.insert(words.end(), flags.begin(), flags.end());
        EXPECT_EQ(run(words).code, 2) << flags[0] << " " << flags[1];
    }
    EXPECT_EQ(run({"voxelize", mesh, "-o", (folder / "a.exr").string()}).code, 2);
    EXPECT_EQ(run({"voxelize", (folder / "absent.obj").string(), "-o", output}).code, 3);
    EXPECT_EQ(run({"voxelize", mesh, "-o", (folder / "no/a.vox").string()}).code, 73);
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"mesh.obj"});
}

TEST(Voxelize, full_disk_leaves_no_file) {
    const ScratchFolder folder;
    const Ending ending =
        run({"voxelize", mesh_file(folder), "-o", (folder / "a.vox").string()}, {.largest_file = 4096});
    EXPECT_EQ(ending.code, 73) << ending.err;
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"mesh.obj"});
}

TEST(Voxelize, file_without_a_name_is_called_as_the_mesh_and_replaces_nothing) {
    const ScratchFolder folder;
    const std::string mesh = mesh_file(folder);
    EXPECT_EQ(run({"voxelize", mesh, "--resolution", "9"}, {.folder = folder.path()}).code, 0);
    EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"mesh.obj", "mesh.vox"}));
    EXPECT_EQ(run({"voxelize", mesh, "--resolution", "9"}, {.folder = folder.path()}).code, 2);
}

}  // namespace
}  // namespace voxilux::test
