// What a display shows of a film, against the same film on the host.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "film/film.h"
#include "film/film_sums.h"
#include "frame/frame.h"
#include "passes/ao/ao.h"
#include "renderer/renderer.h"
#include "shared/cell_age.h"
#include "shared/false_colour.h"
#include "shared/tone_curve.h"
#include "support/device_fixture.h"
#include "support/light_scenes.h"
#include "support/test_scenes.h"
#include "world/world_view.h"
// After it, because it marches rays, too.
#include "shared/camera.h"

namespace voxilux::test {
namespace {

// Two boxes under sun and sky.
Scene display_scene(glm::ivec2 size) {
    Scene scene = white_scene();
    scene.settings = {.size = size, .spp = 4};
    scene.settings.ao.method = AoMethod::brute;
    add_box(scene, {-8, -8, -1}, {8, 8, 0}, add_diffuse(scene, 0.5f));
    add_box(scene, {-8, 2, 0}, {3, 4, 9});
    scene.sun.on = true;
    scene.sun.irradiance = glm::vec3(2.0f, 1.0f, 0.5f);
    scene.camera = camera_towards({20, -40, 25}, {5, 0, 0});
    return scene;
}

constexpr DisplayLook kLook{.exposure = 0.5f};

std::vector<std::uint32_t> displayed(Renderer& renderer, const DisplayLook& look) {
    const DisplayBuffer display = renderer.display(look);
    Recording recording;
    recording.declare({.name = display.buffer,
                       .size_bytes = sizeof(std::uint32_t) * static_cast<std::uint64_t>(display.size.x) *
                                     static_cast<std::uint64_t>(display.size.y),
                       .persistent = true});
    recording.readback(display.buffer);
    return values_of<std::uint32_t>(renderer.executor().run(recording), display.buffer);
}

int code_of(std::uint32_t codes, std::size_t component) {
    return static_cast<int>(codes >> (8 * component) & 0xFFu);
}

// Codes that differ from those of the film by more than the rounding of one.
std::size_t codes_off(const std::vector<std::uint32_t>& shown, const FilmSums& film,
                      const DisplayLook& look) {
    std::size_t off = 0;
    for (std::size_t i = 0; i < 3 * shown.size(); ++i) {
        const std::size_t row = i / 3 / static_cast<std::size_t>(film.width);
        const std::int64_t sum = film.sums.at("beauty_a")[i] + film.sums.at("beauty_b")[i];
        const float exposed = film_mean(sum, film.even[row] + film.odd[row]) * look.exposure;
        const float code = 255.0f * gpu::encode_srgb(gpu::filmic_curve(exposed));
        const std::size_t component = look.is_bgr ? 2 - i % 3 : i % 3;
        if (std::abs(static_cast<float>(code_of(shown[i / 3], component)) - code) > 1.0f) ++off;
    }
    return off;
}

void take_samples(Renderer& renderer, std::uint32_t samples) {
    while (renderer.film().position().samples < samples)
        (void)renderer.step(0.0);
}

TEST(Display, shows_the_mean_of_the_samples_that_each_row_has) {
    Renderer renderer(test_device(), {.poison_transients = true});
    renderer.prepare(display_scene({39, 24}), {});
    EXPECT_EQ(displayed(renderer, kLook), std::vector<std::uint32_t>(39 * 24, 0xFF000000u)) << "no sample";
    take_samples(renderer, 2);
    (void)renderer.step(0.0);
    const FilmSums film = renderer.read_film();
    ASSERT_NE(film.even.front() + film.odd.front(), film.even.back() + film.odd.back());
    EXPECT_EQ(codes_off(displayed(renderer, kLook), film, kLook), 0u);
    const DisplayLook bgr{.exposure = 2.0f, .is_bgr = true};
    EXPECT_EQ(codes_off(displayed(renderer, bgr), film, bgr), 0u);
    EXPECT_NE(codes_off(displayed(renderer, bgr), film, kLook), 0u) << "the negative control";
}

TEST(Display, joins_film_tiles) {
    Scene scene = display_scene({1023, 1100});
    Renderer renderer(test_device(), {});
    renderer.prepare(scene, {});
    ASSERT_EQ(renderer.plan().film_tile_count, 2u);
    while (renderer.film().position().samples < 1)
        (void)renderer.step_tile();
    EXPECT_EQ(codes_off(displayed(renderer, kLook), renderer.read_film(), kLook), 0u);
}

// The false colour of a channel at each pixel, and what the film has there.
TEST(Display, shows_numbers_between_their_ends_as_false_colours) {
    Renderer renderer(test_device(), {.poison_transients = true});
    renderer.prepare(display_scene({39, 24}), {.effects = {.wants_aov = true}});
    take_samples(renderer, 4);
    const Image image = picture_of(renderer.read_film());
    for (const auto& [channel, name, low, high] :
         {std::tuple{DisplayChannel::depth, "Z", 20.0f, 60.0f}, {DisplayChannel::sun, "sun.Y", 0.0f, 1.0f}}) {
        ASSERT_TRUE(has_channel(renderer.plan(), channel));
        const auto shown =
            displayed(renderer, {.channel = channel, .low = glm::vec3(low), .high = glm::vec3(high)});
        std::set<std::uint32_t> colours;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const gpu::vec3 expected =
                gpu::false_colour((image.channels.at(name).pixels[i] - low) / (high - low));
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(code_of(shown[i], c), 255.0f * expected[static_cast<int>(c)], 1.0f)
                    << name << " " << i;
            colours.insert(shown[i]);
        }
        EXPECT_GT(colours.size(), 2u) << name;
    }
}

// The steps of the rays of a pixel on the host.
int host_steps(const gpu::FrameParams& frame, const MarchWorld& world, gpu::uint x, gpu::uint y,
               bool has_shadows) {
    const auto projection = static_cast<gpu::uint>(Projection::perspective);
    const gpu::WorldEntry entry = gpu::enter_world(
        gpu::camera_ray(frame, projection, gpu::kSequenceSobol, x, y), frame.chunks << gpu::kChunkLog2);
    if (!entry.enters) return 0;
    const gpu::MarchHit hit = gpu::march(world, entry.ray, frame.chunks);
    const auto steps = static_cast<int>(hit.steps);
    if (!has_shadows || hit.face >= gpu::kFaceInside) return steps;
    const float outward = (hit.face & 1u) != 0 ? 1.0f : -1.0f;
    if (outward * frame.sun_direction[static_cast<int>(hit.face >> 1u)] <= 0.0f) return steps;
    const gpu::Ray shadow = gpu::spawn_ray(hit.cell, hit.face, gpu::hit_fraction(entry.ray, hit),
                                           frame.sun_direction, gpu::kUnbounded);
    return steps + static_cast<int>(gpu::march(world, shadow, frame.chunks).steps);
}

// Pixels whose shown colour is not that of the steps counted on the host.
std::size_t steps_off(const std::vector<std::uint32_t>& shown, const Renderer& renderer,
                      const DisplayLook& look, bool has_shadows) {
    const gpu::FrameParams frame =
        frame_params(renderer.plan(), renderer.scene(), renderer.prepared().march_world);
    std::size_t off = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const int steps = host_steps(frame, renderer.prepared().march_world, static_cast<gpu::uint>(i % 39),
                                     static_cast<gpu::uint>(i / 39), has_shadows);
        const float taken = std::log10(static_cast<float>(std::max(steps, 1)));
        const gpu::vec3 expected = gpu::false_colour((taken - look.low.x) / (look.high.x - look.low.x));
        bool is_off = false;
        for (std::size_t c = 0; c < 3; ++c)
            is_off |= std::abs(static_cast<float>(code_of(shown[i], c)) -
                               255.0f * expected[static_cast<int>(c)]) > 1.0f;
        off += is_off ? 1 : 0;
    }
    return off;
}

TEST(Display, shows_the_steps_that_the_camera_ray_and_the_shadow_ray_take) {
    const DisplayLook look{.channel = DisplayChannel::steps, .low = glm::vec3(0.0f), .high = glm::vec3(2.0f)};
    Renderer renderer(test_device(), {.poison_transients = true});
    renderer.prepare(display_scene({39, 24}), {});
    const auto before = displayed(renderer, look);
    EXPECT_EQ(steps_off(before, renderer, look, true), 0u) << "before the first sample";
    take_samples(renderer, 2);
    const auto shown = displayed(renderer, look);
    EXPECT_EQ(shown, before) << "and after it";
    EXPECT_GT(steps_off(shown, renderer, look, false), 20u) << "the negative control: without shadow rays";
    EXPECT_GT(std::set(shown.begin(), shown.end()).size(), 5u);
}

TEST(Display, has_no_steps_without_voxels) {
    Scene scene = white_scene();
    scene.settings = {.size = {8, 8}, .spp = 1};
    scene.spheres.push_back({.radius = 3.0, .material = add_diffuse(scene, 0.5f)});
    scene.camera = camera_towards({0, -10, 0}, {0, 0, 0});
    Renderer renderer(test_device(), {});
    renderer.prepare(scene, {});
    EXPECT_FALSE(has_channel(renderer.plan(), DisplayChannel::steps));
}

TEST(Display, shows_the_samples_of_the_cells_that_the_last_sample_saw) {
    Scene scene = display_scene({40, 24});
    scene.settings.ao.method = AoMethod::hash;
    PlanRequest request;
    request.effects.switches[Effect::indirect] = Switch::off;
    request.effects.switches[Effect::ao] = Switch::on;
    request.effects.wants_aov = true;
    const DisplayLook look{.channel = DisplayChannel::cells, .low = glm::vec3(0.0f), .high = glm::vec3(3.0f)};
    Renderer renderer(test_device(), {.poison_transients = true});
    renderer.prepare(scene, request);
    ASSERT_TRUE(has_channel(renderer.plan(), DisplayChannel::cells));
    const std::uint32_t none = displayed(renderer, look).front();
    EXPECT_EQ(none, 0xFF000000u) << "no sample";
    // One, two and three samples: the slots of two of them lie in another plane than the first one's.
    for (const glm::vec3 from : {glm::vec3(20, -40, 25), glm::vec3(-30, -30, 20), glm::vec3(5, -35, 40)}) {
        renderer.set_camera(camera_towards(glm::dvec3(from), {5, 0, 0}));
        take_samples(renderer, 1);
        const auto shown = displayed(renderer, look);
        const std::vector<float> depths = picture_of(renderer.read_film()).channels.at("Z").pixels;
        std::set<std::uint32_t> colours;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            EXPECT_EQ(shown[i] == none, !(depths[i] < 1e6f)) << i << " " << depths[i];
            colours.insert(shown[i]);
        }
        EXPECT_GT(colours.size(), 2u) << "cells differ";
    }
    Recording recording;
    const SeenCells cells = seen_cells(renderer.plan(), 2, recording);
    recording.readback(cells.slots);
    recording.readback(cells.samples);
    const auto shown = displayed(renderer, look);
    const RunResult result = renderer.executor().run(recording);
    const auto slots = values_of<std::uint32_t>(result, cells.slots);
    const auto samples = values_of<std::uint64_t>(result, cells.samples);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (slots[i] == gpu::kNoSlot) continue;
        const auto taken = static_cast<float>(samples[slots[i] & ~gpu::kSlotRests]);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(code_of(shown[i], c),
                        255.0f * gpu::false_colour(std::log10(taken) / 3.0f)[static_cast<int>(c)], 1.0f);
    }
}

TEST(Display, shows_the_reference_and_the_difference_from_the_divider_on) {
    Renderer renderer(test_device(), {.poison_transients = true});
    renderer.prepare(display_scene({39, 24}), {});
    take_samples(renderer, 2);
    std::vector<float> reference(3 * 39 * 24);
    for (std::size_t i = 0; i < reference.size(); ++i)
        reference[i] = static_cast<float>(i % 7) * 0.1f;
    renderer.set_reference(reference);
    const FilmSums film = renderer.read_film();
    for (const DisplayComparison comparison : {DisplayComparison::reference, DisplayComparison::difference}) {
        const auto shown = displayed(renderer, {.comparison = comparison, .divider = 11});
        for (std::size_t i = 0; i < reference.size(); ++i) {
            const float mean = film_mean(film.sums.at("beauty_a")[i] + film.sums.at("beauty_b")[i], 2);
            float value =
                comparison == DisplayComparison::reference ? reference[i] : std::abs(mean - reference[i]);
            if (i / 3 % 39 < 11) value = mean;
            EXPECT_NEAR(code_of(shown[i / 3], i % 3), 255.0f * gpu::encode_srgb(gpu::filmic_curve(value)),
                        1.0f);
        }
    }
    const auto map = displayed(renderer, {.comparison = DisplayComparison::map, .divider = 0});
    for (std::size_t i = 0; i < reference.size(); ++i)
        EXPECT_NEAR(code_of(map[i / 3], i % 3),
                    255.0f * gpu::false_colour(reference[i / 3 * 3])[static_cast<int>(i % 3)], 1.0f);
}

}  // namespace
}  // namespace voxilux::test
