// What the window opens, and what it remembers.

#include "tools/view/view_hut.h"

namespace voxilux::test {
namespace {

std::string drop(const std::string& file) {
    return "[[step]]\ndrop = '" + file + "'\n";
}

// Plays a script on a file, without a given size; the window remembers in state.json.
Ending play_remembered(const ScratchFolder& scratch, const std::string& input, const std::string& script,
                       const Words& more = {}) {
    write_text(scratch / "script.toml", script);
    Ending ending = run(with({"view", input, "--spp", "3", "--script", "script.toml", "--report",
                              "report.json", "--state", "state.json"},
                             more),
                        {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    return ending;
}

TEST(WindowStateNightly, size_frame_time_and_files_come_back) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    write_file_atomically(scratch.path() / "hut.vox", hut());
    play_remembered(scratch, scene_file("first_light"), film(0, "film.exr"), {"--size", "160x90"});
    play_remembered(scratch, "hut.vox", "[[step]]\nresize = [200, 120]\n" + film(4, "film.exr"),
                    {"--size", "160x90", "--frame-time", "20"});
    const Json state = Json::parse(bytes_of(scratch / "state.json"));
    EXPECT_EQ(state["size"], Json({200, 120}));
    EXPECT_EQ(state["frame_ms"], 20.0);
    EXPECT_EQ(state["recent"],
              Json({(scratch.path() / "hut.vox").string(),
                    std::filesystem::path(scene_file("first_light")).lexically_normal().string()}));
    play_remembered(scratch, "hut.vox", film(0, "film.exr") + key("o") + film(8, "other.exr"));
    const Json shown = report_of(scratch)["shown"];
    EXPECT_EQ(shown["window"], Json({200, 120}));
    EXPECT_NE(shown["input"].get<std::string>().find("first_light"), std::string::npos);
    EXPECT_EQ(Json::parse(bytes_of(scratch / "state.json"))["frame_ms"], 20.0);
}

TEST(WindowState, standard_input_takes_the_size_and_is_not_remembered) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    write_file_atomically(scratch.path() / "hut.vox", hut());
    write_text(scratch / "state.json", R"({"size": [200, 120], "frame_ms": 33, "recent": ["/a.vox"]})");
    write_text(scratch / "script.toml", film(0, "film.exr"));
    const std::string command = "cd '" + scratch.path().string() +
                                "' && '" VX_BINARY
                                "' view - --spp 3 --script script.toml --state state.json < hut.vox 2> err";
    EXPECT_EQ(std::system(command.c_str()), 0) << bytes_of(scratch / "err");
    const Json state = Json::parse(bytes_of(scratch / "state.json"));
    EXPECT_EQ(state["size"], Json({200, 120}));
    EXPECT_EQ(state["recent"], Json({"/a.vox"}));
}

TEST(WindowStateNightly, damaged_file_is_ignored_in_one_line) {
    SKIP_UNLESS_DISPLAY();
    for (const char* const damaged : {"{", "[]", "{\"size\": [1], \"frame_ms\": 3, \"recent\": []}",
                                      "{\"size\": [300, 200], \"frame_ms\": 3, \"recent\": [7]}"}) {
        const ScratchFolder scratch;
        write_file_atomically(scratch.path() / "hut.vox", hut());
        write_text(scratch / "state.json", damaged);
        const Ending ending = play_remembered(scratch, "hut.vox", film(0, "film.exr"), {"--size", "160x90"});
        EXPECT_NE(ending.err.find("state.json"), std::string::npos) << ending.err;
        EXPECT_EQ(std::count(ending.err.begin(), ending.err.end(), '\n'), 1) << ending.err;
        EXPECT_EQ(Json::parse(bytes_of(scratch / "state.json"))["size"], Json({160, 90})) << damaged;
    }
}

TEST(WindowDrop, mesh_is_voxelized_as_by_voxelize) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    write_text(scratch / "roof.obj",
               "v 0 0 0\nv 4 0 0\nv 4 0 3\nv 0 0 3\nv 2 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
    play(scratch, film(0, "before.exr") + drop("roof.obj") +
                      "[[step]]\nframe = 8\nscreenshot = 'window.png'\n" + film(9, "roof.exr"));
    const Json shown = report_of(scratch)["shown"];
    EXPECT_EQ(shown["input"], "roof.vox");
    EXPECT_NE(shown["message"].get<std::string>().find("roof.obj became"), std::string::npos) << shown;
    const Ending own = run({"voxelize", "roof.obj", "-o", "own.vox"}, {.folder = scratch.path()});
    ASSERT_EQ(own.code, 0) << own.err;
    EXPECT_EQ(bytes_of(scratch / "roof.vox"), bytes_of(scratch / "own.vox"));
    EXPECT_EQ(film_of(scratch / "roof.exr"), render_of(scratch, "roof.vox"));
}

TEST(WindowDrop, broken_mesh_leaves_the_picture) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    write_text(scratch / "broken.obj", "f 1 2 3\n");
    play(scratch, film(0, "before.exr") + drop("broken.obj") + film(6, "after.exr"));
    EXPECT_EQ(film_of(scratch / "after.exr"), film_of(scratch / "before.exr"));
    EXPECT_FALSE(std::filesystem::exists(scratch / "broken.vox"));
    EXPECT_NE(report_of(scratch)["shown"]["message"].get<std::string>().find("broken.obj"),
              std::string::npos);
}

TEST(WindowDropNightly, unsaved_edits_keep_a_file_away_once) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const std::string edit = key("Tab") + key("r") + click(80, 60) + film(4, "edited.exr");
    const std::string other = drop(scene_file("one_voxel"));
    play_hut(scratch, edit + other + film(8, "kept.exr"));
    EXPECT_EQ(film_of(scratch / "kept.exr"), film_of(scratch / "edited.exr"));
    EXPECT_NE(report_of(scratch)["shown"]["message"].get<std::string>().find("unsaved"), std::string::npos);
    play_hut(scratch, edit + other + other + film(8, "kept.exr"));
    EXPECT_EQ(report_of(scratch)["shown"]["input"], scene_file("one_voxel"));
    play_hut(scratch, edit + held_key("Control", "s") + other + film(8, "kept.exr"));
    EXPECT_EQ(report_of(scratch)["shown"]["input"], scene_file("one_voxel")) << "saved ones do not";
}

TEST(WindowQualityNightly, preset_is_that_of_render) {
    SKIP_UNLESS_DISPLAY();
    const std::string at_end = "[[step]]\nframe = 120\nscreenshot = 'film.exr'\n";
    const Words plain{"--effect", "indirect=off"};
    for (const auto& [scene, more] :
         {std::pair{scene_file("first_light"), plain}, {scene_file("cornell"), {}}}) {
        const ScratchFolder scratch;
        const Ending ending =
            play_scene(scratch, scene, key("g") + at_end + held_key("Control", "c") + pause(124), more);
        EXPECT_EQ(report_of(scratch)["shown"]["quality"], "draft");
        const Ending render = run(with(
            {"render", scene, "--size", "160x90", "--quality", "draft", "-q", "-o", scratch / "render.exr"},
            more));
        ASSERT_EQ(render.code, 0) << render.err;
        EXPECT_EQ(film_of(scratch / "film.exr"), film_of(scratch / "render.exr")) << scene;
        const std::string stem = std::filesystem::path(scene).stem().string();
        EXPECT_EQ(film_of_line(scratch, ending, stem), film_of(scratch / "film.exr"));
    }
}

}  // namespace
}  // namespace voxilux::test
