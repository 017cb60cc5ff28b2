// Windows of a virtual display, driven by scripts: the same code as a person's input.

#include <sys/wait.h>

#include <cstdlib>
#include <span>

#include "base/file.h"

#include "tools/view/view_script.h"

namespace voxilux::test {
namespace {

TEST(WindowFilm, at_rest_it_is_that_of_render) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    play(scratch, film(0, "first.exr") + orbit(5, 20) + film(12, "turned.exr") + "[[step]]\nkey = 'Enter'\n" +
                      film(22, "again.exr"));
    const Ending render = run({"render", scene_file("first_light"), "--size", "160x90", "--spp", "3", "-q",
                               "-o", scratch / "render.exr"});
    ASSERT_EQ(render.code, 0) << render.err;
    const auto rendered = beauty_of(scratch / "render.exr");
    EXPECT_EQ(beauty_of(scratch / "first.exr"), rendered);
    EXPECT_EQ(beauty_of(scratch / "again.exr"), rendered) << "after a motion and back";
    EXPECT_NE(beauty_of(scratch / "turned.exr"), rendered) << "the orbit shows";
    EXPECT_EQ(report_of(scratch)["messages"], Json::array());
}

TEST(WindowFilm, motion_is_coarser_than_rest) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    play(scratch, orbit(3, 10) + film(12, "film.exr"));
    std::set<int> widths;
    const Json report = report_of(scratch);
    for (const Json& frame : report["frames"])
        widths.insert(frame["width"].get<int>());
    EXPECT_TRUE(widths.contains(160));
    EXPECT_LT(*widths.begin(), 160);
}

TEST(WindowFilm, parallel_rays_at_rest_are_those_of_render) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    play_scene(
        scratch, scene_file("sprite"),
        film(0, "first.exr") + orbit(5, 20) + film(12, "turned.exr") + key("Enter") + film(22, "again.exr"));
    EXPECT_EQ(film_of(scratch / "first.exr"),
              render_of(scratch, scene_file("sprite"), {"--background", "sky"}));
    EXPECT_EQ(film_of(scratch / "again.exr"), film_of(scratch / "first.exr"));
    EXPECT_NE(film_of(scratch / "turned.exr"), film_of(scratch / "first.exr")) << "the orbit shows";
    EXPECT_EQ(report_of(scratch)["messages"], Json::array());
}

TEST(WindowEdit, shows_and_its_way_back_is_the_first_picture) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const auto edit = [](const std::string& material) {
        return "[[step]]\nedit = { from = [40, -64, 38], to = [50, -54, 43]" + material + " }\n";
    };
    play(scratch, film(0, "before.exr") + edit(", material = 0") + film(20, "edited.exr") + edit("") +
                      film(40, "after.exr"));
    EXPECT_NE(beauty_of(scratch / "edited.exr"), beauty_of(scratch / "before.exr"));
    EXPECT_EQ(beauty_of(scratch / "after.exr"), beauty_of(scratch / "before.exr"));
    EXPECT_EQ(report_of(scratch)["messages"], Json::array());
}

TEST(WindowSize, resizes_are_followed_without_a_message) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    std::string script;
    for (int i = 0; i < 8; ++i)
        script += "[[step]]\nframe = " + std::to_string(2 * i + 1) + "\nresize = [" +
                  std::to_string(100 + 37 * i % 150) + ", " + std::to_string(60 + 23 * i % 90) + "]\n";
    play(scratch, script + "[[step]]\nresize = [120, 70]\n" + film(30, "film.exr") +
                      "[[step]]\nscreenshot = 'window.png'\n");
    EXPECT_EQ(report_of(scratch)["shown"]["window"], Json({120, 70}));
    EXPECT_EQ(read_image(scratch / "window.png").width, 120);
    EXPECT_EQ(read_image(scratch / "film.exr").width, 120);
    EXPECT_EQ(report_of(scratch)["messages"], Json::array());
}

TEST(WindowDrop, broken_file_leaves_the_picture) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    write_text(scratch / "broken.toml", "[sun\n");
    play(scratch, film(0, "before.exr") + "[[step]]\ndrop = 'broken.toml'\n" + film(6, "after.exr"));
    EXPECT_EQ(beauty_of(scratch / "after.exr"), beauty_of(scratch / "before.exr"));
}

TEST(WindowReload, file_that_somebody_writes_is_shown) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    std::filesystem::copy_file(scene_file("one_voxel"), scratch / "scene.toml");
    write_text(
        scratch / "script.toml",
        film(0, "before.exr") + "[[step]]\nframe = 600\nscreenshot = 'late.png'\n" + film(601, "after.exr"));
    ChildProcess child({"view", "scene.toml", "--size", "96x54", "--spp", "3", "--script", "script.toml",
                        "--report", "report.json"},
                       {.folder = scratch.path()});
    ASSERT_TRUE(wait_for(scratch / "before.exr"));
    const std::string other = bytes_of(scene_file("emitters"));
    write_file_atomically(scratch.path() / "scene.toml", std::as_bytes(std::span(other)));
    ASSERT_EQ(child.finish().code, 0);
    EXPECT_EQ(report_of(scratch)["shown"]["message"], "loaded again");
    EXPECT_NE(beauty_of(scratch / "after.exr"), beauty_of(scratch / "before.exr"));
}

TEST(WindowReloadNightly, file_with_another_camera_brings_it) {
    SKIP_UNLESS_DISPLAY();
    const std::string box =
        "[material.a]\ncolor = '#cc8844'\n[[shape]]\nshape = 'box'\nfrom = [0, 0, 0]\nto = [5, 4, 3]\n"
        "material = 'a'\n[render]\nsize = [160, 90]\n[camera]\npreset = 'iso'\n";
    const ScratchFolder scratch;
    write_text(scratch / "scene.toml", box);
    write_text(scratch / "script.toml", orbit(2, 25) + film(4, "before.exr") +
                                            "[[step]]\nframe = 600\nscreenshot = 'late.png'\n" +
                                            film(601, "after.exr"));
    ChildProcess child({"view", "scene.toml", "--size", "160x90", "--spp", "3", "--script", "script.toml",
                        "--report", "report.json", "--validation"},
                       {.folder = scratch.path()});
    ASSERT_TRUE(wait_for(scratch / "before.exr"));
    const std::string other = box + "projection = 'orthographic'\n";
    write_file_atomically(scratch.path() / "scene.toml", std::as_bytes(std::span(other)));
    ASSERT_EQ(child.finish().code, 0);
    EXPECT_EQ(film_of(scratch / "after.exr"), render_of(scratch, "scene.toml"));
    EXPECT_EQ(report_of(scratch)["messages"], Json::array());
}

TEST(WindowFlags, frames_and_screenshot_need_no_script) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const Ending ending = run({"view", scene_file("first_light"), "--size", "96x54", "--frames", "4",
                               "--screenshot", "a.png", "--report", "report.json"},
                              {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(report_of(scratch)["frames"].size(), 4u);
    EXPECT_GT(report_of(scratch)["first_picture_ms"].get<double>(), 0.0);
    EXPECT_EQ(read_image(scratch / "a.png").width, 96);
}

TEST(WindowError, samples_end_when_the_target_is_claimed) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    play(scratch, "[[step]]\nframe = 100\nscreenshot = 'film.exr'\n", {"--error", "5%"});
    const Json errors = report_of(scratch)["errors"];
    ASSERT_GE(errors.size(), 2u);
    EXPECT_LE(errors.back()["high"].get<double>(), 0.05);
    EXPECT_GT(errors[errors.size() - 2]["high"].get<double>(), 0.05);
    const auto samples = errors.back()["samples"].get<std::uint32_t>();
    EXPECT_EQ(read_image(scratch / "film.exr").channels.at("sampleCount.Y").pixels[0], samples);
    const Ending render = run({"render", scene_file("first_light"), "--size", "160x90", "--spp",
                               std::to_string(samples), "-q", "-o", scratch / "render.exr"});
    EXPECT_EQ(render.code, 0) << render.err;
    EXPECT_EQ(beauty_of(scratch / "film.exr"), beauty_of(scratch / "render.exr"));
}

TEST(WindowErrorNightly, nothing_is_claimed_where_light_is_missing) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const auto samples_with = [&](const std::string& sky) {
        play(scratch, "[[step]]\nframe = 60\nscreenshot = 'film.exr'\n",
             {"--error", "50%", "-D", "sky.radiance=" + sky});
        return read_image(scratch / "film.exr").channels.at("sampleCount.Y").pixels[0];
    };
    EXPECT_EQ(samples_with("[1, 1, 1]"), 4.0f) << "the first look is enough";
    EXPECT_GT(samples_with("[1e6, 1e6, 1e6]"), 4.0f) << "brighter than the film holds";
    EXPECT_EQ(report_of(scratch)["errors"], Json::array());
}

TEST(WindowError, samples_end_with_the_time) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    play(scratch,
         "[[step]]\nframe = 30\nscreenshot = 'early.exr'\n[[step]]\nframe = 40\n"
         "screenshot = 'late.exr'\n",
         {"--error", "0.01%", "--time-limit", "0.2s"});
    EXPECT_EQ(beauty_of(scratch / "early.exr"), beauty_of(scratch / "late.exr"));
}

TEST(WindowFlags, bad_script_is_refused_with_its_line) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    write_text(scratch / "script.toml", "[[step]]\nkey = 'Hyper'\n");
    const Ending ending =
        run({"view", scene_file("first_light"), "--script", "script.toml"}, {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 3);
    EXPECT_NE(ending.err.find("script.toml:2"), std::string::npos) << ending.err;
}

TEST(WindowDisplay, none_is_one_line_that_names_render) {
    const ScratchFolder scratch;
    const std::string file = scratch / "err";
    const int status = std::system(("DISPLAY= WAYLAND_DISPLAY= " VX_PLAIN_BINARY " view 2> " + file).c_str());
    EXPECT_EQ(WEXITSTATUS(status), 69);
    const std::string said = bytes_of(file);
    EXPECT_NE(said.find("voxilux render"), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

}  // namespace
}  // namespace voxilux::test
