// Frames rendered one after the other on one device, against each frame alone.

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "formats/vox_read.h"
#include "jobs/render_session.h"
#include "scene/vox_scene.h"
#include "support/frame_fixture.h"
#include "support/test_scenes.h"
#include "support/vox_builder.h"

namespace voxilux::test {
namespace {

RenderOptions validated() {
    RenderOptions options{.plan = {.effects = {.wants_aov = true}}};
    options.device.validation = true;
    options.device.on_message = [](std::string_view text) { ADD_FAILURE() << text; };
    options.executor.poison_transients = true;
    return options;
}

// A corner of two boxes on 40 x 24 pixels, without anything that frames share.
Scene small_scene() {
    Scene scene = white_scene();
    scene.settings = {.size = {40, 24}, .spp = 2};
    scene.settings.ao.method = AoMethod::brute;
    add_box(scene, {-8, -8, -1}, {8, 8, 0});
    add_box(scene, {-8, 2, 0}, {3, 4, 9});
    scene.sun.irradiance = glm::vec3(2.0f);
    return scene;
}

Scene turning_scene() {
    Scene scene = small_scene();
    scene.camera.reset();
    scene.animation.turntable = Turntable{.frames = 5};
    return scene;
}

// A file of two models that take turns and move, in front of the boxes.
Scene walking_scene() {
    using namespace vox_builder;
    const std::string chunks =
        chiral_model(3, 4, 5) + chiral_model(2, 2, 2) +
        transform(0, 1, -1, {{{"_f", "0"}, {"_t", "0 -4 2"}}, {{"_f", "2"}, {"_t", "12 -4 2"}}}) +
        shape(1, {{0, {{"_f", "0"}}}, {1, {{"_f", "3"}}}});
    Scene scene = small_scene();
    place_vox(scene, add_vox(scene, read_vox(file(chunks, 200)).value(), 0), Rotation{}, glm::ivec3(0));
    scene.camera = camera_towards({20, -40, 25}, {5, 0, 0});
    return scene;
}

Scene sphere_scene() {
    Scene scene = turning_scene();
    scene.models.clear();
    scene.instances.clear();
    scene.spheres = {{{0.5, 0.25, 0.0}, 3.0, 0}, {{6.0, 1.0, 1.0}, 2.0, 0}};
    return scene;
}

std::vector<std::string> different_channels(const Image& a, const Image& b) {
    std::vector<std::string> names;
    if (a.channels.size() != b.channels.size()) names.push_back("their number");
    for (const auto& [name, channel] : a.channels) {
        const auto other = b.channels.find(name);
        if (other == b.channels.end() || other->second.pixels != channel.pixels) names.push_back(name);
    }
    return names;
}

bool built_a_world(const RenderOutcome& outcome) {
    const std::vector<StepTime>& steps = outcome.statistics.steps;
    return std::ranges::find(steps, "structure", &StepTime::label) != steps.end();
}

struct Sequenced {
    const char* name;
    Scene (*scene)();
};

void PrintTo(const Sequenced& sequenced, std::ostream* out) {
    *out << sequenced.name;
}

class FrameSequence : public testing::TestWithParam<Sequenced> {};

// Frames out of order and one of them twice: nothing of a frame may be left in the next.
TEST_P(FrameSequence, frame_is_the_picture_of_its_scene_alone) {
    const Scene scene = GetParam().scene();
    RenderSession session(scene, validated());
    std::optional<Image> before;
    for (const std::int64_t frame : {1, 2, 3, 0, 4, 1}) {
        const RenderOutcome outcome = session.render(frame, {});
        const RenderOutcome alone = render_scene(scene_at_frame(scene, frame), validated());
        EXPECT_EQ(different_channels(outcome.image, alone.image), std::vector<std::string>{}) << frame;
        for (const auto& [name, count] : outcome.statistics.faults)
            EXPECT_EQ(count, 0u) << name;
        if (before) {  // negative control: each differs from the one before it
            EXPECT_NE(different_channels(outcome.image, *before), std::vector<std::string>{}) << frame;
        }
        before = outcome.image;
    }
    EXPECT_EQ(session.end(), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(scenes, FrameSequence,
                         testing::Values(Sequenced{"turntable", &turning_scene},
                                         Sequenced{"vox", &walking_scene},
                                         Sequenced{"spheres", &sphere_scene}),
                         [](const auto& test) { return test.param.name; });

TEST(FrameSequenceOf, camera_that_moves_uploads_no_world) {
    RenderSession session(turning_scene(), validated());
    EXPECT_TRUE(built_a_world(session.render(1, {})));
    EXPECT_FALSE(built_a_world(session.render(2, {})));
    EXPECT_FALSE(built_a_world(session.render(9, {})));
}

TEST(FrameSequenceOf, world_is_uploaded_when_a_voxel_moves) {
    RenderSession session(walking_scene(), validated());
    std::string built;
    for (std::int64_t frame = 0; frame < 6; ++frame)
        built += built_a_world(session.render(frame, {})) ? 'x' : '.';
    EXPECT_EQ(built, "x.xx..");  // a key at 2, another model from 3
}

// The plan lists what one picture alone needs, so it must hold for the last frame of many, too.
TEST(FrameSequenceOf, device_holds_no_more_after_many_frames) {
    RenderSession session(walking_scene(), validated());
    const auto bytes = [&](std::int64_t frame) {
        const RenderOutcome outcome = session.render(frame, {});
        std::uint64_t sum = 0;
        for (const MemoryRow& row : outcome.statistics.memory)
            sum += row.bytes;
        return sum;
    };
    const std::uint64_t first = bytes(0);
    for (std::int64_t frame = 1; frame < 8; ++frame)
        (void)bytes(frame);
    EXPECT_EQ(bytes(0), first);
}

}  // namespace
}  // namespace voxilux::test
