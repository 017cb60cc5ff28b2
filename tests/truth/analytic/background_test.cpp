// Images with a background against the same scene in front of its sky: what the scene covers must be equal,
// sample by sample.

#include <gtest/gtest.h>

#include <cmath>

#include "base/colour.h"
#include "film/tonemap.h"
#include "support/frame_fixture.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

// The film rounds each sample to 2^-24, and means to floats; the beauty is stored as such.
constexpr float kRounding = 1e-6f;

// Blocks, a ball and a glass ball before a coloured sky, so small that many pixels are at edges.
Scene blocks(bool has_glass) {
    Scene scene = test::white_scene();
    scene.materials[0].albedo = glm::vec3(0.5f, 0.7f, 0.2f);
    scene.materials.push_back(
        {.albedo = glm::vec3(0.9f), .surface = Surface::glass, .roughness = 0.0f, .transmission = 1.0f});
    test::add_box(scene, {-4, -4, 0}, {4, 4, 2});
    test::add_box(scene, {-3, 1, 2}, {-1, 3, 7});
    scene.spheres.push_back({{2.5, -1.0, 3.5}, 1.5, has_glass ? 1u : 0u});
    scene.sky.radiance = glm::vec3(0.3f, 0.6f, 1.1f);
    scene.sun.on = true;
    scene.camera = test::camera_towards({9, -13, 8}, {0, 0, 2}, 50.0);
    scene.settings.size = {48, 36};
    scene.settings.spp = 8;
    return scene;
}

Image render(Scene scene, Backdrop shown) {
    scene.background = {shown, glm::vec3(0.2f, 0.05f, 0.6f)};
    return test::render_validated(scene, {.plan = {.effects = {.wants_aov = true}}}).image;
}

const std::vector<float>& plane(const Image& image, const char* name) {
    return image.channels.at(name).pixels;
}

TEST(Background, alpha_is_the_share_of_samples_that_meet_the_scene) {
    Scene scene = blocks(false);
    scene.materials[0].albedo = glm::vec3(1.0f);
    const Image image = render(scene, Backdrop::transparent);
    int edges = 0;
    for (std::size_t i = 0; i < pixel_count(image); ++i) {
        const float alpha = plane(image, "A")[i];
        EXPECT_NEAR(alpha, plane(image, "albedo.R")[i], kRounding) << i;
        EXPECT_EQ(alpha, std::round(8.0f * alpha) / 8.0f) << i;
        edges += alpha > 0.0f && alpha < 1.0f ? 1 : 0;
    }
    EXPECT_GT(edges, 50);
    EXPECT_FALSE(render(scene, Backdrop::sky).channels.contains("A"));
}

// Colours are premultiplied, so the rest is the sky's.
TEST(BackgroundNightly, scene_and_sky_add_up_to_the_image_with_its_sky) {
    for (const bool has_glass : {false, true}) {
        const Scene scene = blocks(has_glass);
        const Image whole = render(scene, Backdrop::sky);
        const Image cut = render(scene, Backdrop::transparent);
        int differing = 0;
        for (int c = 0; c < 3; ++c) {
            const char* const name = c == 0 ? "R" : (c == 1 ? "G" : "B");
            for (std::size_t i = 0; i < pixel_count(whole); ++i) {
                const float alpha = plane(cut, "A")[i];
                const float sum = plane(cut, name)[i] + (1.0f - alpha) * scene.sky.radiance[c];
                ASSERT_NEAR(sum, plane(whole, name)[i], 4.0f * kRounding) << i << " glass " << has_glass;
                differing += plane(cut, name)[i] != plane(whole, name)[i] ? 1 : 0;
            }
        }
        EXPECT_GT(differing, 100) << "negative control";
    }
}

// Glass covers what is behind it, whatever it shows.
TEST(Background, glass_is_opaque) {
    Scene scene = blocks(true);
    scene.spheres[0] = {{0, 0, 0}, 3.0, 1u};
    scene.models.clear();
    scene.instances.clear();
    scene.camera = test::camera_towards({0.1, -2.5, 0.1}, {0, 9, 0}, 40.0);  // inside
    const Image image = render(scene, Backdrop::transparent);
    for (const float alpha : plane(image, "A"))
        EXPECT_EQ(alpha, 1.0f);
}

// A slab over the ground, of which only the shadow is shown, in a sun without a sky: alpha is 1 in the shadow
// and 0 elsewhere.
TEST(Background, ground_that_catches_shadows_covers_by_the_light_that_it_lacks) {
    Scene scene = test::white_scene();
    scene.materials[0].albedo = glm::vec3(0.0f);
    test::add_box(scene, {0, 0, 3}, {4, 4, 4});
    scene.sun = {.azimuth_deg = 180.0f, .elevation_deg = 45.0f, .angular_diameter_deg = 0.0f, .on = true};
    scene.sky.radiance = glm::vec3(0.0f);
    scene.ground = {.on = true, .albedo = glm::vec3(0.37f, 0.2f, 0.6f), .shadow_only = true, .height = 0.0};
    scene.camera = test::camera_down({7.0, 2.0, 200.0}, 3.0);
    scene.camera->projection = Projection::orthographic;
    scene.camera->pixels_per_voxel = 4.0;
    scene.settings.size = {64, 24};
    const Image image = render(scene, Backdrop::transparent);
    int shadow = 0, open = 0;
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double place = 7.0 + (x + 0.5 - 32.0) / 4.0, side = 2.0 - (y + 0.5 - 12.0) / 4.0;
            const bool is_slab = place > 0.0 && place < 4.0 && side > 0.0 && side < 4.0;
            // The sun is at -x, as high as it is far: shadows fall 3 to 4 voxels further.
            const bool is_shadow = !is_slab && place > 3.0 && place < 8.0 && side > 0.0 && side < 4.0;
            const float alpha = plane(image, "A")[static_cast<std::size_t>(64 * y + x)];
            EXPECT_NEAR(alpha, is_slab || is_shadow ? 1.0f : 0.0f, 1e-5f) << x << " " << y;
            EXPECT_EQ(plane(image, "R")[static_cast<std::size_t>(64 * y + x)], 0.0f);
            shadow += is_shadow ? 1 : 0;
            open += alpha < 0.5f ? 1 : 0;
        }
    }
    EXPECT_GT(shadow, 200);
    EXPECT_GT(open, 800);
}

// Nothing stands on the ground: no alpha, whatever sun and sky are.
TEST(Background, ground_without_shadows_is_not_there) {
    Scene scene = blocks(false);
    scene.models.clear();
    scene.instances.clear();
    scene.spheres.clear();
    scene.ground = {.on = true, .shadow_only = true, .height = 0.0};
    scene.camera = test::camera_towards({9, -13, 8}, {0, 0, -5}, 30.0);
    const Image image = render(scene, Backdrop::transparent);
    for (const float alpha : plane(image, "A"))
        EXPECT_NEAR(alpha, 0.0f, 2e-3f);  // the cosine varies over the sun's disc, by half its angle
}

std::uint8_t code(float decoded) {
    return srgb_code(decoded);
}

TEST(Background, alpha_over_any_colour_is_the_render_over_that_colour_within_one_code) {
    const Image cut = render(blocks(true), Backdrop::transparent);
    const DisplayImage straight = to_display(cut);
    for (const glm::ivec3 colour : {glm::ivec3(0), {255, 255, 255}, {255, 0, 12}, {7, 99, 201}}) {
        ToneMapOptions options;
        options.background.emplace();
        for (int c = 0; c < 3; ++c)
            (*options.background)[c] = linear_from_srgb(static_cast<std::uint8_t>(colour[c]));
        const DisplayImage laid = to_display(cut, options);
        EXPECT_FALSE(laid.image.channels.contains("A"));
        for (std::size_t i = 0; i < pixel_count(cut); ++i) {
            // As a browser does it: 8-bit codes and an 8-bit alpha.
            const double alpha = std::round(255.0f * plane(straight.image, "A")[i]) / 255.0;
            for (int c = 0; c < 3; ++c) {
                const char* const name = c == 0 ? "R" : (c == 1 ? "G" : "B");
                const double over = alpha * code(plane(straight.image, name)[i]) + (1.0 - alpha) * colour[c];
                ASSERT_LE(std::abs(std::round(over) - code(plane(laid.image, name)[i])), 1.0) << i << name;
            }
        }
    }
}

TEST(Background, what_nothing_covers_has_exactly_the_code_of_the_colour) {
    Image image = make_image(2, 1, std::vector<std::string>{"R", "G", "B", "A"});
    image.channels["A"].pixels = {0.0f, 1.0f};
    image.channels["R"].pixels = {0.0f, 0.25f};
    for (int i = 0; i < 256; ++i) {
        const float linear = linear_from_srgb(static_cast<std::uint8_t>(i));
        ToneMapOptions options;
        options.background = glm::vec3(linear);
        const Image shown = to_display(image, options).image;
        ASSERT_EQ(code(plane(shown, "G")[0]), i);
        ASSERT_EQ(code(plane(shown, "R")[1]), code(tone_map(0.25f, ToneMap::filmic)));
    }
}

// Two worlds in which a shadow catcher cannot lack light: a dark one with an emitter, and a black ground
// under the sky.
TEST(BackgroundNightly, ground_that_catches_shadows_where_there_is_no_light_is_not_there) {
    for (const bool is_black : {false, true}) {
        Scene scene = test::white_scene();
        if (!is_black) {
            scene.materials[0] = {
                .albedo = glm::vec3(0.0f), .emission = glm::vec3(3.0f), .surface = Surface::emit};
            scene.sky.radiance = glm::vec3(0.0f);
        }
        test::add_box(scene, {0, 0, 3}, {4, 4, 4});
        scene.ground = {
            .on = true, .albedo = glm::vec3(is_black ? 0.0f : 0.4f), .shadow_only = true, .height = 0.0};
        scene.camera = test::camera_down({2.0, 2.0, 200.0}, 3.0);
        scene.camera->projection = Projection::orthographic;
        scene.camera->pixels_per_voxel = 4.0;
        scene.settings.size = {48, 32};
        const Image image = render(scene, Backdrop::transparent);
        int slab = 0;
        for (const float alpha : plane(image, "A")) {
            ASSERT_TRUE(alpha == 0.0f || alpha == 1.0f) << alpha << ", black: " << is_black;
            slab += alpha == 1.0f ? 1 : 0;
        }
        EXPECT_EQ(slab, 16 * 16);
    }
}

}  // namespace
}  // namespace voxilux
