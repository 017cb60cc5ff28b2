// Orthographic images against ones drawn here, voxel by voxel: with a whole number of pixels per voxel and a
// view from a side, each pixel shows one voxel, whatever its samples.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "film/tonemap.h"
#include "formats/png.h"
#include "scene/scene_camera.h"
#include "support/frame_fixture.h"
#include "support/scratch_folder.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

constexpr int kEdge = 16;
constexpr int kColours = 60;

// Radiance of a voxel's material, which is that of the image, because nothing else shines.
glm::vec3 glow(int material) {
    return glm::vec3(material % 5, material / 5 % 4, material / 20) / 4.0f;
}

// Random voxels, a third of all, that shine and reflect nothing.
Scene shining_model() {
    Scene scene = test::white_scene();
    scene.sky.radiance = glm::vec3(0.0f);
    scene.materials.clear();
    for (int i = 0; i < kColours; ++i)
        scene.materials.push_back({.albedo = glm::vec3(0.0f), .emission = glow(i), .surface = Surface::emit});
    VoxelModel model{.size = glm::ivec3(kEdge)};
    std::mt19937 random(16);
    for (std::uint16_t x = 0; x < kEdge; ++x)
        for (std::uint16_t y = 0; y < kEdge; ++y)
            for (std::uint16_t z = 0; z < kEdge; ++z)
                if (random() % 3 == 0)
                    model.voxels.push_back(
                        {x, y, z, static_cast<std::uint16_t>(1 + random() % (kColours - 1))});
    for (const std::uint16_t corner :
         {std::uint16_t{0}, std::uint16_t{kEdge - 1}})  // so that the box is full for any random numbers
        model.voxels.push_back({corner, corner, corner, 7});
    scene.models = {std::move(model)};
    scene.instances = {{.model = 0}};
    scene.settings.spp = 3;
    return scene;
}

// Materials by cell, -1 for air.
std::vector<int> grid_of(const Scene& scene) {
    std::vector<int> grid(kEdge * kEdge * kEdge, -1);
    for (const Voxel& v : scene.models[0].voxels)
        grid[static_cast<std::size_t>((v.z * kEdge + v.y) * kEdge + v.x)] = v.material;
    return grid;
}

// The cell at `depth` behind the voxel that a view shows at a column and a row (from the top).
glm::ivec3 cell_behind(View view, int column, int row, int depth) {
    const int last = kEdge - 1;
    switch (view) {
        case View::front:
            return {column, depth, last - row};
        case View::back:
            return {last - column, last - depth, last - row};
        case View::left:
            return {depth, last - column, last - row};
        case View::right:
            return {last - depth, column, last - row};
        case View::top:
            return {column, last - row, last - depth};
        default:  // bottom
            return {column, row, depth};
    }
}

std::uint8_t code_of(float radiance) {
    const double shown = std::min(static_cast<double>(radiance), 1.0);
    const double coded = shown <= 0.0031308 ? 12.92 * shown : 1.055 * std::pow(shown, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * coded));
}

// The bytes of the image: three codes a pixel.
std::vector<std::uint8_t> drawn(const Scene& scene, View view, int scale) {
    const std::vector<int> grid = grid_of(scene);
    std::vector<std::uint8_t> codes;
    for (int y = 0; y < kEdge * scale; ++y) {
        for (int x = 0; x < kEdge * scale; ++x) {
            int seen = -1;
            for (int depth = 0; depth < kEdge && seen < 0; ++depth) {
                const glm::ivec3 cell = cell_behind(view, x / scale, y / scale, depth);
                seen = grid[static_cast<std::size_t>((cell.z * kEdge + cell.y) * kEdge + cell.x)];
            }
            for (int c = 0; c < 3; ++c)
                codes.push_back(seen < 0 ? std::uint8_t{0} : code_of(glow(seen)[c]));
        }
    }
    return codes;
}

// `aside` is the distance in voxels from the camera to where it would frame the model.
std::vector<std::uint8_t> rendered(Scene scene, View view, int scale, glm::dvec3 aside = glm::dvec3(0.0)) {
    Camera looking = looking_along(view);
    looking.projection = Projection::orthographic;
    looking.pixels_per_voxel = scale;
    scene.settings.size = sprite_size(scene, looking);
    EXPECT_EQ(scene.settings.size, glm::ivec2(kEdge * scale));
    scene.camera = framing_camera(scene, looking);
    scene.camera->position += aside;
    const RenderOutcome outcome = test::render_validated(scene);
    const ScratchFolder scratch;
    write_png(scratch / "a.png", to_display(outcome.image, {.curve = ToneMap::plain}).image);
    const Image png = read_png(scratch / "a.png");
    std::vector<std::uint8_t> codes;
    for (std::size_t i = 0; i < pixel_count(png); ++i)
        for (const char* channel : {"R", "G", "B"})
            codes.push_back(code_of(png.channels.at(channel).pixels[i]));
    return codes;
}

TEST(Sprite, of_sixteen_cubed_at_four_pixels_per_voxel_equals_the_drawing_from_all_sides) {
    const Scene scene = shining_model();
    for (const View view : {View::front, View::back, View::left, View::right, View::top, View::bottom})
        EXPECT_EQ(rendered(scene, view, 4), drawn(scene, view, 4)) << static_cast<int>(view);
}

TEST(Sprite, has_pixel_borders_where_voxels_have_at_scales_that_are_no_power_of_two) {
    const Scene scene = shining_model();
    for (const int scale : {1, 3, 7})
        EXPECT_EQ(rendered(scene, View::left, scale), drawn(scene, View::left, scale)) << scale;
}

TEST(Sprite, negative_control_sees_a_camera_that_is_a_pixel_aside) {
    Scene scene = shining_model();
    EXPECT_NE(rendered(scene, View::front, 4, {0.25, 0.0, 0.0}), drawn(scene, View::front, 4));
    scene.instances[0].translation.x = 1;  // the box moves along, and so does the camera
    EXPECT_EQ(rendered(scene, View::front, 4), drawn(scene, View::front, 4));
    scene.models[0].voxels.back().material = 0;  // in the corner at the top
    EXPECT_NE(rendered(scene, View::top, 4), drawn(shining_model(), View::top, 4));
}

}  // namespace
}  // namespace voxilux
