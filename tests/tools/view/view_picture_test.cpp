// What the window shows of a film, against the film itself.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "estimators/flip.h"
#include "formats/scene_toml.h"
#include "scene/scene_bounds.h"
#include "shared/false_colour.h"
#include "shared/tone_curve.h"
#include "tools/view/view_script.h"

namespace voxilux::test {
namespace {

using Codes = std::array<double, 3>;

// How many pixels of a window are not what `expected` says, by more than the rounding of a code and of the
// halves of an EXR, which is below two codes even where the filmic curve is steepest.
// Pixels that `is_free` names may show anything.
int wrong_pixels(const std::filesystem::path& file, const std::function<Codes(std::size_t)>& expected,
                 const std::function<bool(std::size_t)>& is_free = {}) {
    constexpr double kCode = 2.1 / 255.0;
    const auto shown = beauty_of(file);
    int wrong = 0;
    for (std::size_t i = 0; i < shown.at("R").size(); ++i) {
        if (is_free && is_free(i)) continue;
        const Codes codes = expected(i);
        const Codes seen{gpu::encode_srgb(shown.at("R")[i]), gpu::encode_srgb(shown.at("G")[i]),
                         gpu::encode_srgb(shown.at("B")[i])};
        for (std::size_t c = 0; c < 3; ++c)
            if (!(std::abs(seen[c] - codes[c]) <= kCode)) {
                ++wrong;
                break;
            }
    }
    return wrong;
}

double filmic_code(float radiance) {
    return gpu::encode_srgb(gpu::filmic_curve(std::max(radiance, 0.0f)));
}

std::function<Codes(std::size_t)> filmic(const Planes& planes) {
    return [&](std::size_t i) {
        return Codes{filmic_code(planes.at("R")[i]), filmic_code(planes.at("G")[i]),
                     filmic_code(planes.at("B")[i])};
    };
}

Codes codes_of(gpu::vec3 colour) {
    return {colour.x, colour.y, colour.z};
}

// A rendered EXR of the scene with its AOVs.
Image rendered_image(const ScratchFolder& scratch, const Words& more = {}) {
    (void)render_of(scratch, scene_file("first_light"), more);
    return read_image(scratch / "render.exr");
}

// Depths of the nearest and of the farthest corner of a box.
std::array<double, 2> depths_of(const Camera& camera, const Box& box) {
    const double yaw = glm::radians(camera.yaw_deg), pitch = glm::radians(camera.pitch_deg);
    const glm::dvec3 forward{std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw),
                             std::sin(pitch)};
    std::array<double, 2> depths{1e9, 0.0};
    for (const int x : {box.lo.x, box.hi.x})
        for (const int y : {box.lo.y, box.hi.y})
            for (const int z : {box.lo.z, box.hi.z}) {
                const double depth = glm::dot(glm::dvec3(x, y, z) - camera.position, forward);
                depths = {std::min(depths[0], depth), std::max(depths[1], depth)};
            }
    return depths;
}

TEST(WindowPicture, shows_codes_of_the_film_with_exposure_and_curve) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    play(scratch, key("Tab") + film(0, "filmic.png") + key("t") + key("Plus") + pause(9) +
                      film(10, "plain.png") + film(11, "film.exr"));
    const auto planes = beauty_of(scratch / "film.exr");
    EXPECT_EQ(wrong_pixels(scratch / "filmic.png", filmic(planes)), 0);
    const float half_stop = std::exp2(0.5f);
    const auto plain = [&](std::size_t i) {
        Codes codes;
        for (std::size_t c = 0; c < 3; ++c)
            codes[c] = gpu::encode_srgb(std::min(half_stop * planes.at(std::string(1, "RGB"[c]))[i], 1.0f));
        return codes;
    };
    EXPECT_EQ(wrong_pixels(scratch / "plain.png", plain), 0);
    EXPECT_GT(wrong_pixels(scratch / "filmic.png", plain), 1000) << "the curve shows";
}

TEST(WindowPicture, shows_every_channel_as_the_film_has_it) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    std::string script = key("Tab");
    int frame = 0;
    for (const char* name : {"albedo", "normal", "position", "depth", "ao", "sun", "error"}) {
        script += key("c") + film(frame + 2, std::string(name) + ".png");
        frame += 2;
    }
    const Words with_ao{"--effect", "ao=on"};
    play(scratch, script, with_ao);
    const Image image = rendered_image(scratch, with_ao);
    const auto value = [&](const char* name, std::size_t i) { return image.channels.at(name).pixels[i]; };
    const auto numbers = [&](const char* name, double low, double high) {
        return [=](std::size_t i) {
            return codes_of(gpu::false_colour(static_cast<float>((value(name, i) - low) / (high - low))));
        };
    };
    const Scene scene = load_scene(scene_file("first_light"));
    const Box box = scene_bounds(scene);
    const glm::dvec3 size(box.hi - box.lo);
    const auto place = [&](std::size_t i) {
        const glm::dvec3 point(value("P.X", i), value("P.Y", i), value("P.Z", i));
        const glm::dvec3 share = glm::clamp((point - glm::dvec3(box.lo)) / size, 0.0, 1.0);
        return Codes{share.x, share.y, share.z};
    };
    EXPECT_EQ(wrong_pixels(scratch / "position.png", place), 0);
    const std::array<double, 2> depths = depths_of(*scene.camera, box);
    EXPECT_EQ(wrong_pixels(scratch / "depth.png", numbers("Z", depths[0], depths[1])), 0);
    EXPECT_EQ(wrong_pixels(scratch / "ao.png", numbers("ao.Y", 0.0, 1.0)), 0);
    EXPECT_EQ(wrong_pixels(scratch / "sun.png", numbers("sun.Y", 0.0, 1.0)), 0);
    EXPECT_EQ(wrong_pixels(scratch / "albedo.png",
                           [&](std::size_t i) {
                               return Codes{gpu::encode_srgb(value("albedo.R", i)),
                                            gpu::encode_srgb(value("albedo.G", i)),
                                            gpu::encode_srgb(value("albedo.B", i))};
                           }),
              0);
    EXPECT_EQ(wrong_pixels(scratch / "normal.png",
                           [&](std::size_t i) {
                               return Codes{0.5 + 0.5 * value("N.X", i), 0.5 + 0.5 * value("N.Y", i),
                                            0.5 + 0.5 * value("N.Z", i)};
                           }),
              0);
    EXPECT_EQ(wrong_pixels(scratch / "error.png",
                           [&](std::size_t i) {
                               const float error = std::max(value("error.Y", i), 1e-20f);
                               return codes_of(gpu::false_colour((std::log10(error) + 3.0f) / 3.0f));
                           }),
              0);
    EXPECT_EQ(report_of(scratch)["shown"]["channel"], "error");
    EXPECT_EQ(report_of(scratch)["messages"], Json::array());
}

TEST(WindowPicture, shows_the_cells_of_occlusion_and_the_steps_of_rays) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const std::string back = held_key("Shift", "c");
    const std::string script =
        key("Tab") + film(0, "color.png") + back + film(12, "steps.png") + back + film(24, "cells.png");
    play(scratch, script, {"--effect", "ao=on", "--technique", "ao=hash"});
    EXPECT_EQ(report_of(scratch)["shown"]["channel"], "cells");
    EXPECT_EQ(report_of(scratch)["messages"], Json::array());
    // The colours of numbers have an order that no picture of the scene has: red is never below green.
    const auto cells = beauty_of(scratch / "cells.png");
    int black = 0, lit = 0;
    for (std::size_t i = 0; i < cells.at("R").size(); ++i) {
        EXPECT_GE(cells.at("R")[i], 0.5f * cells.at("G")[i]) << i;
        const bool is_black = cells.at("R")[i] + cells.at("G")[i] + cells.at("B")[i] == 0.0f;
        (is_black ? black : lit) += 1;
    }
    EXPECT_GT(black, 1000) << "the sky has no cell";
    EXPECT_GT(lit, 1000);
    // Everywhere rays take steps. Where a colour lies follows from display_test.cpp.
    const auto steps = beauty_of(scratch / "steps.png");
    for (std::size_t i = 0; i < steps.at("R").size(); ++i)
        EXPECT_GE(steps.at("R")[i], 0.5f * steps.at("G")[i]) << i;
    EXPECT_NE(steps, cells);
    play(scratch, script, {"--effect", "ao=on", "--technique", "ao=brute"});
    EXPECT_EQ(beauty_of(scratch / "cells.png"), beauty_of(scratch / "color.png")) << "there are none";
}

TEST(WindowPicture, reads_out_what_the_film_has_under_the_pointer) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    play(scratch, "[[step]]\nmove = [80, 60]\n" + film(0, "film.exr") + pause(9) +
                      "[[step]]\nmove = [80, 60]\n" + film(12, "window.png"));
    const Image image = read_image(scratch / "film.exr");
    const Json pixel = report_of(scratch)["shown"]["pixel"];
    const std::size_t at = 60 * 160 + 80;
    EXPECT_EQ(pixel["place"], Json({80, 60}));
    EXPECT_EQ(pixel["samples"], 3);
    const float radiance = image.channels.at("G").pixels[at];
    EXPECT_NEAR(pixel["radiance"][1].get<float>(), radiance, radiance * 0x1p-11f) << "the EXR has halves";
    EXPECT_FLOAT_EQ(pixel["error"].get<float>(), image.channels.at("error.Y").pixels[at]);
    const Image aovs = rendered_image(scratch);
    const auto vector_at = [&](const char* x, const char* y, const char* z) {
        return glm::dvec3(aovs.channels.at(x).pixels[at], aovs.channels.at(y).pixels[at],
                          aovs.channels.at(z).pixels[at]);
    };
    const Scene scene = load_scene(scene_file("first_light"));
    const glm::dvec3 point = vector_at("P.X", "P.Y", "P.Z");
    const glm::dvec3 normal = vector_at("N.X", "N.Y", "N.Z");
    const glm::dvec3 way = point - scene.camera->position;
    // The readout is of the middle of the pixel, the samples lie anywhere in it: up to half its diagonal
    // away, and farther on a surface that is seen at a slant.
    const double pixel_width = 2.0 * std::tan(glm::radians(scene.camera->fov_y_deg) / 2.0) / 90.0;
    const double reach =
        std::numbers::sqrt2 / 2.0 * pixel_width * glm::dot(way, way) / -glm::dot(way, normal);
    ASSERT_LT(reach, 1.5) << "voxels: it tells voxels apart";
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel["voxel"][c].get<double>() + 0.5, point[c] - 0.5 * normal[c], 0.5 + reach);
    const glm::vec3 albedo = scene.materials.at(pixel["material"].get<std::size_t>()).albedo;
    EXPECT_NEAR(aovs.channels.at("albedo.R").pixels[at], albedo.x, albedo.x * 0x1p-11f);
    EXPECT_NEAR(aovs.channels.at("albedo.G").pixels[at], albedo.y, albedo.y * 0x1p-11f);
    EXPECT_NEAR(aovs.channels.at("albedo.B").pixels[at], albedo.z, albedo.z * 0x1p-11f);
}

TEST(WindowWipe, shows_the_reference_beyond_the_divider) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    ASSERT_EQ(run({"render", scene_file("first_light"), "--size", "160x90", "--spp", "1", "--seed", "9", "-q",
                   "-o", scratch / "reference.exr"})
                  .code,
              0);
    play(scratch, key("Tab") + film(0, "film.exr") + "[[step]]\ndrop = 'reference.exr'\n" + pause(9) +
                      "[[step]]\nmove = [80, 45]\n[[step]]\npress = 'left'\n[[step]]\nmove = [40, 45]\n" +
                      "[[step]]\nrelease = 'left'\n" + pause(12) + film(13, "wipe.png") + key("x") +
                      pause(16) + film(17, "difference.png"));
    const auto film = beauty_of(scratch / "film.exr"), reference = beauty_of(scratch / "reference.exr");
    // The divider itself is a line of one pixel between two columns.
    const auto is_line = [](std::size_t i) { return i % 160 == 39 || i % 160 == 40; };
    const auto left = filmic(film), right = filmic(reference);
    const auto wipe = [&](std::size_t i) { return i % 160 < 40 ? left(i) : right(i); };
    EXPECT_EQ(wrong_pixels(scratch / "wipe.png", wipe, is_line), 0);
    EXPECT_GT(wrong_pixels(scratch / "wipe.png", left, is_line), 1000) << "the reference shows";
    const auto difference = [&](std::size_t i) {
        if (i % 160 < 40) return left(i);
        Codes codes;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::string name(1, "RGB"[c]);
            codes[c] = filmic_code(std::abs(film.at(name)[i] - reference.at(name)[i]));
        }
        return codes;
    };
    EXPECT_EQ(wrong_pixels(scratch / "difference.png", difference, is_line), 0);
}

TEST(WindowWipe, shows_flip_beyond_the_divider) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const Image reference = rendered_image(scratch, {"-D", "sun.elevation=20"});
    play(scratch, "[[step]]\ndrop = 'render.exr'\n" + key("Tab") + key("x") + key("x") +
                      "[[step]]\nmove = [80, 45]\n[[step]]\npress = 'left'\n[[step]]\nmove = [40, 45]\n" +
                      "[[step]]\nrelease = 'left'\n[[step]]\nmove = [3, 3]\n" + film(12, "film.exr") +
                      "[[step]]\nframe = 20\nscreenshot = 'flip.png'\n");
    const auto film_planes = beauty_of(scratch / "film.exr");
    const std::optional<FlipResult> flip = hdr_flip(reference, read_image(scratch / "film.exr"));
    ASSERT_TRUE(flip);
    const auto is_line = [](std::size_t i) { return i % 160 == 39 || i % 160 == 40; };
    const auto left = filmic(film_planes);
    const auto wipe = [&](std::size_t i) {
        return i % 160 < 40 ? left(i) : codes_of(gpu::false_colour(flip->error[i]));
    };
    EXPECT_EQ(wrong_pixels(scratch / "flip.png", wipe, is_line), 0);
    EXPECT_GT(wrong_pixels(scratch / "flip.png", left, is_line), 1000) << "the map shows";
    double sum = 0.0;
    for (const float error : flip->error)
        sum += static_cast<double>(error);
    // The window has the film itself, this test the halves of an EXR. FLIP raises distances to the power 0.7,
    // so the rounding of a half, 2^-12 of a value, is up to 0.003 where two images are alike.
    EXPECT_NEAR(report_of(scratch)["shown"]["flip"].get<double>(), sum / (160.0 * 90.0), 3e-3);
}

}  // namespace
}  // namespace voxilux::test
