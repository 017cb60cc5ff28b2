// Several inputs and cameras in one call, and sheets of their pictures, as a user renders them.

#include <gtest/gtest.h>

#include <algorithm>

#include "formats/png.h"
#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/models.h"

namespace voxilux::test {
namespace {

long line_count(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

TEST(Batch, renders_every_input_from_every_camera_with_one_line_each) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox");
    write_model(scratch / "b.vox");
    const Ending ending = run(with({"render", "a.vox", "b.vox", "--camera", "front", "--camera", "iso",
                                    "--camera", "2", "-o", "{name}_{camera}.png"},
                                   kSmall),
                              {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err, "");
    EXPECT_EQ(line_count(ending.out), 6) << ending.out;
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.vox", "a_2.png", "a_front.png", "a_iso.png", "b.vox",
                                               "b_2.png", "b_front.png", "b_iso.png"}));
    EXPECT_EQ(bytes_of(scratch / "a_iso.png"), bytes_of(scratch / "b_iso.png"));
    EXPECT_NE(bytes_of(scratch / "a_iso.png"), bytes_of(scratch / "a_2.png"));
    const Ending alone = run(with({"render", "b.vox", "--camera", "2", "-q", "-o", "alone.png"}, kSmall),
                             {.folder = scratch.path()});
    EXPECT_EQ(alone.code, 0) << alone.err;
    EXPECT_EQ(bytes_of(scratch / "alone.png"), bytes_of(scratch / "b_2.png"))
        << "a picture of a batch is the one that a render of its own gives";
}

TEST(Batch, goes_on_after_a_file_that_cannot_be_rendered) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox");
    write_text(scratch / "bad.vox", "VOX nonsense");
    write_model(scratch / "c.vox");
    const Ending ending =
        run(with({"render", "a.vox", "bad.vox", "no.toml", "c.vox", "--json", "r.json"}, kSmall),
            {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 3) << ending.err;
    EXPECT_EQ(line_count(ending.err), 2) << ending.err;
    EXPECT_NE(ending.err.find("voxilux: bad.vox: "), std::string::npos) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.png", "a.vox", "bad.vox", "c.png", "c.vox", "r.json"}));
    EXPECT_EQ(Json::parse(bytes_of(scratch / "r.json")).size(), 2u);
}

TEST(Batch, goes_on_after_a_file_without_the_camera) {
    const ScratchFolder scratch;
    const std::string bytes = bytes_of_model_without_camera();
    write_text(scratch / "a.vox", bytes);
    write_model(scratch / "b.vox");
    const Ending ending =
        run(with({"render", "a.vox", "b.vox", "--camera", "2", "-q"}, kSmall), {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 2);
    EXPECT_EQ(line_count(ending.err), 1) << ending.err;
    EXPECT_TRUE(ending.err.starts_with("voxilux: a.vox: --camera: there is no '2'")) << ending.err;
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.vox", "b.png", "b.vox"}));
}

TEST(Batch, refuses_what_is_of_one_picture) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox");
    write_model(scratch / "b.vox");
    for (const Words& more :
         {Words{"--samples", "0-1"}, {"--shard", "1/2"}, {"--resume"}, {"--checkpoint", "9"}}) {
        const Ending ending =
            run(with({"render", "a.vox", "b.vox", "-o", "{name}.exr"}, more), {.folder = scratch.path()});
        EXPECT_EQ(ending.code, 2);
        EXPECT_NE(ending.err.find(" are for one picture; render the inputs one by one\n"), std::string::npos)
            << ending.err;
    }
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.vox", "b.vox"}));
}

TEST(Batch, refuses_a_sheet_or_a_report_in_place_of_another_file) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox");
    write_model(scratch / "b.vox");
    const auto refused = [&](const Words& more) {
        const Ending ending =
            run(with(with({"render", "a.vox", "b.vox"}, kSmall), more), {.folder = scratch.path()});
        EXPECT_EQ(ending.code, 2);
        return ending.err;
    };
    EXPECT_NE(refused({"--sheet", "a.png"}).find("a.png: is written twice"), std::string::npos);
    EXPECT_NE(refused({"--sheet", "s.png", "--json", "s.png"}).find("s.png: is written twice"),
              std::string::npos);
    EXPECT_NE(refused({"--json", "b.vox"}).find("b.vox: is an input"), std::string::npos);
    EXPECT_NE(refused({"--turntable", "2", "--sheet", "b.0002.png"}).find("b.0002.png: is written twice"),
              std::string::npos);
    EXPECT_NE(refused({"--sheet", "s.png", "-o", "{name}.exr"}).find("--sheet: it shows the PNGs"),
              std::string::npos);
    EXPECT_EQ(names_in(scratch.path()), (Words{"a.vox", "b.vox"}));
}

TEST(Batch, report_of_frames_is_that_of_their_render) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox");
    write_model(scratch / "b.vox");
    const Ending ending = run(
        with({"render", "a.vox", "b.vox", "--turntable", "2", "-q", "--json", "r.json", "--sheet", "s.png"},
             kSmall),
        {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    const Json reports = Json::parse(bytes_of(scratch / "r.json"));
    ASSERT_EQ(reports.size(), 2u);
    for (const Json& report : reports)
        EXPECT_EQ(report["frames"].size(), 2u);
    const Image sheet = read_png(scratch / "s.png");
    EXPECT_EQ(sheet.width * sheet.height, 4 * 24 * 16) << "two pictures of each file";
}

TEST(Batch, refuses_two_pictures_of_one_name) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox");
    const Surroundings here{.folder = scratch.path()};
    const Ending ending =
        run({"render", "a.vox", "--camera", "front", "--camera", "top", "-o", "x.png"}, here);
    EXPECT_EQ(ending.code, 2);
    EXPECT_NE(ending.err.find("two pictures would be written to x.png; put {name} or {camera} into -o"),
              std::string::npos)
        << ending.err;
    EXPECT_EQ(run({"render", "a.vox", "a.vox"}, here).code, 2);
    EXPECT_EQ(run({"plan", "a.vox", "--camera", "front", "--camera", "top"}, here).code, 2);
    const Ending unknown = run({"render", "a.vox", "--camera", "7", "-o", "x.png"}, here);
    EXPECT_EQ(unknown.code, 2);
    EXPECT_NE(unknown.err.find("there is no '7'"), std::string::npos) << unknown.err;
    EXPECT_NE(unknown.err.find("of the file 2"), std::string::npos) << unknown.err;
}

TEST(Batch, sheet_holds_all_pictures_in_rows) {
    const ScratchFolder scratch;
    write_model(scratch / "a.vox");
    const Ending ending = run(with({"render", "a.vox", "--camera", "front", "--camera", "left", "--camera",
                                    "top", "--sheet", "sheet.png", "-q"},
                                   kSmall),
                              {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    const Image sheet = read_png(scratch / "sheet.png");
    EXPECT_EQ(sheet.width, 48);
    EXPECT_EQ(sheet.height, 32);
    const Image left = read_png(scratch / "a_left.png");
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 24; ++x)
            ASSERT_EQ(sheet.channels.at("G").pixels[static_cast<std::size_t>(y * 48 + 24 + x)],
                      left.channels.at("G").pixels[static_cast<std::size_t>(y * 24 + x)]);
}

}  // namespace
}  // namespace voxilux::test
