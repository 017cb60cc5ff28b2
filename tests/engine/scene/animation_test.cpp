#include "scene/animation.h"
#include "formats/vox_read.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "formats/scene_toml.h"
#include "scene/scene_camera.h"
#include "scene/scene_hash.h"
#include "scene/vox_scene.h"
#include "support/scene_voxels.h"
#include "support/scratch_folder.h"
#include "support/shared_data.h"
#include "support/vox_builder.h"

namespace voxilux {
namespace {

using namespace vox_builder;
using Cells = std::set<std::tuple<int, int, int>>;

Cells cells_of(const Scene& scene) {
    Cells cells;
    test::for_each_scene_voxel(scene, [&](glm::ivec3 c, std::uint16_t) { cells.insert({c.x, c.y, c.z}); });
    return cells;
}

// Two keys that move and turn, two models that take turns: a single voxel, and a bar of two along x, whose
// pivot is its second cell.
std::string walker() {
    return size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 1}}) + size_chunk(2, 1, 1) +
           voxels_chunk({{0, 0, 0, 2}, {1, 0, 0, 2}}) +
           transform(0, 1, -1, {{{"_f", "0"}, {"_t", "5 0 0"}}, {{"_f", "4"}, {"_t", "9 2 1"}}}) +
           shape(1, {{0, {{"_f", "0"}}}, {1, {{"_f", "3"}}}}, {{"_loop", "1"}});
}

class AnimatedScene : public testing::Test {
  protected:
    AnimatedScene() {
        write_file_atomically(folder_ / "w.vox", file(walker(), 200));
        write_file_atomically(folder_ / "dot.vox",
                              file(size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 3}}), 200));
    }

    [[nodiscard]] Scene parse(const std::string& text) const { return parse_scene(text, folder_ / "s.toml"); }
    [[nodiscard]] Scene walking() const { return load_scene(folder_ / "w.vox"); }

    ScratchFolder folder_;
};

// By hand: the place holds from key to key, the models change every third and fourth frame.
const std::map<std::int64_t, Cells> kWalk = {{0, {{5, 0, 0}}},
                                             {2, {{5, 0, 0}}},
                                             {3, {{4, 0, 0}, {5, 0, 0}}},
                                             {4, {{9, 2, 1}}},
                                             {6, {{9, 2, 1}}},
                                             {7, {{8, 2, 1}, {9, 2, 1}}},
                                             {8, {{9, 2, 1}}},
                                             {1003, {{8, 2, 1}, {9, 2, 1}}}};

TEST_F(AnimatedScene, vox_file_shows_each_frame_its_own_cells) {
    const Scene scene = walking();
    EXPECT_EQ(frames_of(scene), (FrameRange{0, 4}));
    EXPECT_EQ(cells_of(scene), kWalk.at(0)) << "as it was loaded";
    for (const auto& [frame, cells] : kWalk)
        EXPECT_EQ(cells_of(scene_at_frame(scene, frame)), cells) << frame;
    EXPECT_NE(cells_of(scene_at_frame(scene, 3)), kWalk.at(2))
        << "negative control: a frame later is another";
}

TEST_F(AnimatedScene, player_tells_when_voxels_change) {
    FramePlayer player(walking());
    std::string changes;
    for (std::int64_t frame = 0; frame < 9; ++frame) {
        EXPECT_EQ(player.show(frame).camera->position, player.show(frame).camera->position);
        changes += player.has_new_voxels() ? 'x' : '.';
        (void)player.show(frame == 8 ? 8 : frame + 1);
        changes += player.has_new_voxels() ? 'x' : '.';
    }
    // Showing a frame again changes nothing; frames 2 to 3, 3 to 4, 6 to 7 and 7 to 8 do.
    EXPECT_EQ(changes,
              "...."
              ".x"
              ".x"
              ".."
              ".."
              ".x"
              ".x"
              "..");
}

TEST_F(AnimatedScene, placed_file_moves_among_things_that_stand) {
    const Scene scene = parse(
        "[[model]]\nfile = \"dot.vox\"\ntranslate = [100, 0, 0]\n"
        "[[model]]\nfile = \"w.vox\"\nrotate = \"z90\"\ntranslate = [0, 0, 50]\n"
        "[[model]]\nfile = \"w.vox\"\nframe = 3\n"
        "[[model]]\nfile = \"dot.vox\"\ntranslate = [200, 0, 0]\n");
    // A quarter turn about z takes cell (x, y) to (-1 - y, x).
    const auto expected = [](const Cells& walk) {
        Cells cells{{100, 0, 0}, {200, 0, 0}, {4, 0, 0}, {5, 0, 0}};
        for (const auto& [x, y, z] : walk)
            cells.insert({-1 - y, x, z + 50});
        return cells;
    };
    for (const auto& [frame, cells] : kWalk) {
        const Scene still = scene_at_frame(scene, frame);
        EXPECT_EQ(cells_of(still), expected(cells)) << frame;
        EXPECT_EQ(still.instances.front().translation.x, 100) << "in the order of the file";
        EXPECT_EQ(still.instances.back().translation.x, 200);
        EXPECT_TRUE(still.animation.is_still());
    }
}

TEST_F(AnimatedScene, default_camera_stands_still_and_sees_all_key_frames) {
    const Scene scene = walking();
    EXPECT_EQ(bounds_of_frames(scene), (Box{{4, 0, 0}, {10, 3, 2}}))
        << "of frames 0, 3 and 4: cells 5, 4 and 5, 9";
    const Camera first = *scene_at_frame(scene, 0).camera;
    EXPECT_EQ(first.position, scene_at_frame(scene, 7).camera->position);
    EXPECT_EQ(first.position, camera_of(scene).position);
}

TEST_F(AnimatedScene, hidden_and_empty_models_have_no_cells) {
    const std::string chunks =
        size_chunk(1, 1, 1) + voxels_chunk({}) + size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 1}}) +
        transform(0, 1, -1, {{}}) + group(1, {2, 4}) + transform(2, 3, -1, {{}}) +
        shape(3, {{0, {{"_f", "0"}}}, {1, {{"_f", "2"}}}}) + transform(4, 5, -1, {{}}, {{"_hidden", "1"}}) +
        shape(5, {{1, {{"_f", "0"}}}, {0, {{"_f", "2"}}}});
    write_file_atomically(folder_ / "h.vox", file(chunks, 200));
    const Scene scene = load_scene(folder_ / "h.vox");
    EXPECT_EQ(cells_of(scene_at_frame(scene, 1)), Cells{});
    EXPECT_EQ(cells_of(scene_at_frame(scene, 2)), (Cells{{0, 0, 0}}));
}

TEST_F(AnimatedScene, place_out_of_reach_is_refused) {
    const std::string chunks = size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 1}}) +
                               transform(0, 1, -1, {{{"_f", "0"}}, {{"_f", "2"}, {"_t", "268435456 0 0"}}}) +
                               transform(1, 2, -1, {{{"_t", "1 0 0"}}}) + shape(2, {{0, {}}});
    write_file_atomically(folder_ / "far.vox", file(chunks, 200));
    const Scene scene = load_scene(folder_ / "far.vox");
    EXPECT_THROW((void)visible_instances(scene.models, scene.animation.files.at(0), 2), Error);
    EXPECT_EQ(visible_instances(scene.models, scene.animation.files.at(0), 1).size(), 1u);
    EXPECT_THROW((void)FramePlayer(scene), Error) << "before anything is rendered";
}

TEST_F(AnimatedScene, frames_are_those_of_the_camera_or_of_the_file) {
    const std::string model = "[[model]]\nfile = \"w.vox\"\n";
    EXPECT_EQ(frames_of(parse("")), std::nullopt);
    EXPECT_EQ(frames_of(parse("[[model]]\nfile = \"dot.vox\"\n")), std::nullopt);
    EXPECT_EQ(frames_of(parse("[[model]]\nfile = \"w.vox\"\nframe = 2\n")), std::nullopt);
    EXPECT_EQ(frames_of(parse(model)), (FrameRange{0, 4}));
    EXPECT_EQ(frames_of(parse("[camera]\nturntable.frames = 24\n" + model)), (FrameRange{1, 24}));
    const std::string keys =
        "[[camera.key]]\nframe = 3\nposition = [9,9,9]\nlook_at = [0,0,0]\n"
        "[[camera.key]]\nframe = 8\nposition = [1,9,9]\nlook_at = [0,0,0]\n";
    EXPECT_EQ(frames_of(parse(keys + model)), (FrameRange{3, 8}));
}

TEST(VoxFrames, file_may_say_its_range) {
    const auto range = [](const std::string& meta) {
        const auto text = chunk("META", dict({{"_anim_range", meta}}));
        return frames_of(read_vox(file(walker() + text, 200)).value());
    };
    EXPECT_EQ(range("2 30"), (FrameRange{2, 30}));
    for (const char* nonsense : {"", "3", "30 2", "-1 4", "a b", "0 1000001", "0 1e9", "1 2 3"})
        EXPECT_EQ(range(nonsense), (FrameRange{0, 4})) << nonsense;
}

TEST_F(AnimatedScene, hash_covers_what_moves) {
    const std::string keys =
        "[[camera.key]]\nframe = 3\nposition = [9,9,9]\nlook_at = [0,0,0]\n"
        "[[camera.key]]\nframe = 8\nposition = [1,9,9]\nlook_at = [0,0,0]\n";
    std::set<std::uint64_t> hashes;
    const auto is_new = [&](const Scene& scene) { return hashes.insert(scene_hash(scene)).second; };
    EXPECT_TRUE(is_new(parse("")));
    EXPECT_TRUE(is_new(parse("[camera]\nturntable.frames = 24\n")));
    EXPECT_TRUE(is_new(parse("[camera]\nturntable.frames = 25\n")));
    EXPECT_TRUE(is_new(parse("[camera.turntable]\nframes = 25\ndegrees = 90\n")));
    EXPECT_TRUE(is_new(parse("[camera.turntable]\nframes = 25\nstart = 90\n")));
    EXPECT_TRUE(is_new(parse(keys)));
    EXPECT_TRUE(is_new(parse("[camera]\npath = \"linear\"\n" + keys)));
    Scene scene = parse(keys);
    scene.animation.camera_keys[1].frame = 9;
    EXPECT_TRUE(is_new(scene));
    scene.animation.camera_keys[1].camera.yaw_deg += 1.0;
    EXPECT_TRUE(is_new(scene));
    scene.animation.camera_keys[1].look_at.reset();
    EXPECT_TRUE(is_new(scene));
    Scene walk = walking();
    EXPECT_TRUE(is_new(walk));
    EXPECT_FALSE(is_new(walking()));
    std::get<VoxTransform>(walk.animation.files[0].graph.nodes[0]).frames[1][1].second = "9 2 2";
    EXPECT_TRUE(is_new(walk));
    walk.animation.placements[0].translation.x = 1;
    EXPECT_TRUE(is_new(walk));
    walk.animation.files[0].models[1] = 0;
    EXPECT_TRUE(is_new(walk));
}

std::string refusal(const std::string& text) {
    try {
        (void)parse_scene(text, "s.toml");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        return error.what();
    }
    return "accepted";
}

TEST(CameraMotionText, path_is_read) {
    const Scene scene = parse_scene(
        "[camera]\npath = \"linear\"\nfov = 30\n"
        "[[camera.key]]\nframe = 0\nposition = [10, 0, 0]\nlook_at = [0, 0, 0]\n"
        "[[camera.key]]\nframe = 4\nposition = [10, 8, 0]\nyaw = 90\npitch = 5\nfov = 50\n",
        "s.toml");
    const Camera middle = *scene_at_frame(scene, 2).camera;
    EXPECT_EQ(middle.position, glm::dvec3(10.0, 4.0, 0.0));
    EXPECT_DOUBLE_EQ(middle.yaw_deg, 135.0);
    EXPECT_DOUBLE_EQ(middle.pitch_deg, 2.5);
    EXPECT_DOUBLE_EQ(middle.fov_y_deg, 40.0);
}

TEST(CameraMotionText, slips_are_refused_with_their_place) {
    const std::string one = "[[camera.key]]\nframe = 5\nposition = [1,2,3]\nlook_at = [0,0,0]\n";
    EXPECT_EQ(refusal(one),
              "s.toml:1:1: [camera] needs two [[camera.key]] or more; a camera that stands needs none");
    EXPECT_EQ(refusal(one + one),
              "s.toml:6:9: 'frame' in [[camera.key]] must be above 5, that of the key before, not 5");
    EXPECT_EQ(refusal("[[camera.key]]\nposition = [1,2,3]\nlook_at = [0,0,0]\n"),
              "s.toml:1:1: [[camera.key]] needs 'frame'");
    EXPECT_EQ(refusal("[[camera.key]]\nframe = -1\n"),
              "s.toml:2:9: 'frame' in [[camera.key]] must be a whole number in [0, 1000000], not -1");
    EXPECT_EQ(refusal("[[camera.key]]\nframe = 1\n"), "s.toml:1:1: [[camera.key]] needs 'position'");
    EXPECT_EQ(refusal("[[camera.key]]\nfrme = 1\n"),
              "s.toml:2:1: unknown key 'frme' in [[camera.key]]; did you mean 'frame'?");
    EXPECT_EQ(refusal("[camera]\nposition = [1,2,3]\nlook_at = [0,0,0]\n" + one),
              "s.toml:2:12: 'position' in [camera] excludes [[camera.key]]: the keys place the camera");
    EXPECT_EQ(
        refusal("[camera]\nturntable.frames = 3\n" + one).find("s.toml:2:1: 'turntable' in [camera] excl"),
        0u);
    EXPECT_EQ(refusal("[camera]\nkey = 3\n"),
              "s.toml:2:7: 'key' in [camera] must be sections [[camera.key]] in double brackets");
    EXPECT_EQ(refusal("[camera]\npath = \"smooth\"\n"),
              "s.toml:2:8: 'path' in [camera] needs [[camera.key]]");
    EXPECT_EQ(refusal("[camera]\nturntable = 3\n"),
              "s.toml:2:13: 'turntable' in [camera] must be a section [camera.turntable]");
    EXPECT_EQ(refusal("[camera.turntable]\nframes = 0\n"),
              "s.toml:2:10: 'frames' in [camera.turntable] must be a whole number in [1, 1000000], not 0");
    EXPECT_EQ(refusal("[camera.turntable]\n"), "s.toml:1:1: [camera.turntable] needs 'frames'");
    EXPECT_EQ(refusal("[camera.turntable]\nframes = 9\ndegrees = 0\n"),
              "s.toml:3:11: 'degrees' in [camera.turntable] must not be 0: the camera would stand");
}

// Three files of three kinds: models of a shape, keys of a transform, models of a PACK.
TEST(AnimationExternal, shared_files_play) {
    SKIP_WITHOUT_SHARED_DATA();
    const auto load = [](const char* name) { return load_scene(shared_data() / "data" / "vox" / name); };
    const auto counts = [](const Scene& scene, std::int64_t frames) {
        std::vector<std::size_t> of_frame;
        for (std::int64_t frame = 0; frame < frames; ++frame)
            of_frame.push_back(cells_of(scene_at_frame(scene, frame)).size());
        return of_frame;
    };
    const Scene deer = load("deer.vox");  // counts of its XYZI chunks; the shape names models 1, 2, 3, 0
    EXPECT_EQ(frames_of(deer), (FrameRange{0, 3}));
    EXPECT_EQ(counts(deer, 6), (std::vector<std::size_t>{355, 351, 358, 351, 355, 351}));
    const Scene rex = load("T-Rex.vox");
    EXPECT_EQ(frames_of(rex), (FrameRange{0, 7}));
    EXPECT_EQ(counts(rex, 9),
              (std::vector<std::size_t>{1272, 1265, 1287, 1284, 1268, 1272, 1287, 1284, 1272}));
    const Scene mover = load("animation.0.99.7.1.vox");
    EXPECT_EQ(frames_of(mover), (FrameRange{0, 30}));
    const auto place = [&](std::int64_t frame) {
        return scene_at_frame(mover, frame).instances.at(0).translation;
    };
    EXPECT_EQ(place(8), glm::ivec3(14, -29, 20));
    EXPECT_EQ(place(9), glm::ivec3(-29, 31, 20));
    EXPECT_EQ(place(30), glm::ivec3(-131, -29, 20));
    EXPECT_EQ(place(31), glm::ivec3(14, -29, 20)) << "its nodes loop";
}

}  // namespace
}  // namespace voxilux
