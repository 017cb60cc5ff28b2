// What the settings of a .vox file become. The files are written here, byte by byte.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formats/vox_info.h"
#include "formats/vox_objects.h"
#include "formats/vox_read.h"
#include "scene/angles.h"
#include "scene/scene_camera.h"
#include "scene/vox_settings.h"
#include "support/vox_builder.h"

namespace voxilux {
namespace {

using namespace vox_builder;

std::string object(const Pairs& pairs) {
    return chunk("rOBJ", dict(pairs));
}

Scene scene_of(const std::string& chunks) {
    const auto file = read_vox(vox_builder::file(chiral_model(2, 2, 2) + chunks));
    EXPECT_TRUE(file) << (file ? "" : file.reason());
    Scene scene;
    apply_vox_settings(file.value(), render_objects(file.value()), scene);
    return scene;
}

std::string usual_objects() {
    return object({{"_type", "_bounce"}, {"_diffuse", "2"}, {"_specular", "5"}}) +
           object({{"_type", "_env"}, {"_mode", "0"}}) +
           object({{"_type", "_inf"},
                   {"_i", "0.7"},
                   {"_k", "255 255 255"},
                   {"_angle", "50 50"},
                   {"_area", "0.07"}}) +
           object({{"_type", "_uni"}, {"_i", "0.7"}, {"_k", "255 255 255"}}) +
           object({{"_type", "_lens"}, {"_fov", "45"}, {"_aperture", "0.25"}}) +
           object({{"_type", "_film"}, {"_expo", "1"}, {"_aces", "1"}}) +
           object({{"_type", "_ground"}, {"_color", "80 80 80"}, {"_hor", "0.1"}}) +
           object({{"_type", "_bg"}, {"_color", "0 0 0"}}) +
           object({{"_type", "_setting"}, {"_ground", "1"}, {"_bg_c", "0"}, {"_bg_a", "0"}});
}

TEST(VoxSettings, defaults_of_the_editor_change_nothing) {
    const Scene scene = scene_of(usual_objects());
    EXPECT_EQ(scene.sun.irradiance, Sun{}.irradiance);
    EXPECT_EQ(scene.sun.azimuth_deg, Sun{}.azimuth_deg);
    EXPECT_EQ(scene.sky.radiance, Sky{}.radiance);
    EXPECT_FALSE(scene.ground.on);
    EXPECT_EQ(scene.background.shown, Backdrop::sky);
    EXPECT_EQ(scene.framing_fov_y_deg, 45.0);
    EXPECT_FALSE(scene.exposure_ev);
    EXPECT_TRUE(scene.notes.empty());
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(VoxSettings, sun_and_sky_are_taken) {
    const Scene scene = scene_of(
        object({{"_type", "_inf"}, {"_i", "2"}, {"_k", "255 0 188"}, {"_angle", "30 90"}, {"_area", "0.1"}}) +
        object({{"_type", "_uni"}, {"_i", "0.5"}, {"_k", "255 255 0"}}));
    EXPECT_FLOAT_EQ(scene.sun.elevation_deg, 30.0f);
    EXPECT_NEAR(glm::length(scene.sun.direction() - glm::vec3(-std::sqrt(0.75f), 0.0f, 0.5f)), 0.0f, 1e-6f)
        << "clockwise from the front, -y: on the left";
    EXPECT_FLOAT_EQ(scene.sun.angular_diameter_deg, 4.35f);
    EXPECT_FLOAT_EQ(scene.sun.irradiance.x, static_cast<float>(2.0 * std::numbers::pi));
    EXPECT_EQ(scene.sun.irradiance.y, 0.0f);
    EXPECT_NEAR(scene.sun.irradiance.z / scene.sun.irradiance.x, 0.5029f, 1e-4f);  // of the sRGB code 188
    EXPECT_EQ(scene.sky.radiance, glm::vec3(0.5f, 0.5f, 0.0f));
}

TEST(VoxSettings, modes_of_the_sky) {
    const std::string air = object(
        {{"_type", "_atm"}, {"_ray_d", "0.8"}, {"_mie_d", "0.2"}, {"_mie_g", "0.7"}, {"_o3_d", "0.4"}});
    const Scene scene = scene_of(object({{"_type", "_env"}, {"_mode", "1"}}) + air);
    EXPECT_EQ(scene.sky.model, SkyModel::atmosphere);
    EXPECT_FLOAT_EQ(scene.sky.rayleigh, 2.0f);
    EXPECT_FLOAT_EQ(scene.sky.mie, 0.5f);
    EXPECT_FLOAT_EQ(scene.sky.ozone, 1.0f);
    EXPECT_FLOAT_EQ(scene.sky.mie_g, 0.7f);
    EXPECT_EQ(scene_of(air).sky.model, SkyModel::constant);
    const Scene image = scene_of(object({{"_type", "_env"}, {"_mode", "2"}}) +
                                 object({{"_type", "_ibl"}, {"_path", "night.hdr"}}));
    EXPECT_TRUE(image.notes.empty());
    EXPECT_EQ(image.sky.model, SkyModel::image);
    EXPECT_EQ(image.sky.image_file, "night.hdr");
    EXPECT_FLOAT_EQ(image.sky.rotation_deg, 90.0f) << "the middle of the image is behind the model";
    const Scene nameless = scene_of(object({{"_type", "_env"}, {"_mode", "2"}}));
    EXPECT_EQ(nameless.sky.model, SkyModel::constant);
    ASSERT_EQ(nameless.notes.size(), 1u);
    EXPECT_EQ(nameless.notes[0], "the settings name no image of the sky: our sky is shown");
}

TEST(VoxSettings, ground_and_background) {
    const std::string dark = object({{"_type", "_ground"}, {"_color", "17 17 17"}, {"_hor", "0"}});
    const Scene scene = scene_of(dark);
    EXPECT_TRUE(scene.ground.on);
    EXPECT_NEAR(scene.ground.albedo.x, 0.0056f, 1e-4f);
    EXPECT_FALSE(scene_of(dark + object({{"_type", "_setting"}, {"_ground", "0"}})).ground.on);
    EXPECT_FALSE(scene_of(object({{"_type", "_ground"}, {"_color", "1 2 3"}, {"_enable", "0"}})).ground.on);
    const std::string red = object({{"_type", "_bg"}, {"_color", "255 0 0"}});
    EXPECT_EQ(scene_of(red).background.shown, Backdrop::sky);
    const Scene shown = scene_of(red + object({{"_type", "_setting"}, {"_bg_c", "1"}}));
    EXPECT_EQ(shown.background.shown, Backdrop::color);
    EXPECT_EQ(shown.background.radiance, glm::vec3(1, 0, 0));
    EXPECT_EQ(scene_of(object({{"_type", "_setting"}, {"_bg_a", "1"}})).background.shown,
              Backdrop::transparent);
}

TEST(VoxSettings, lens_film_and_what_is_not_shown) {
    const Scene scene = scene_of(
        object({{"_type", "_lens"}, {"_fov", "30"}, {"_aperture", "1"}}) +
        object({{"_type", "_film"}, {"_expo", "4"}, {"_vig", "0.5"}, {"_gam", "2.2"}}) +
        object({{"_type", "_fog_uni"}, {"_d", "0.7"}}) + object({{"_type", "_bounce"}, {"_diffuse", "9"}}));
    EXPECT_EQ(scene.framing_fov_y_deg, 30.0);
    EXPECT_FLOAT_EQ(scene.exposure_ev.value(), 2.0f);
    EXPECT_EQ(scene.notes.size(), 4u);
}

TEST(VoxSettings, chunks_of_older_files_say_the_same) {
    const Scene scene = scene_of(
        chunk("rLIT", dict({{"_type", "inf"}, {"_I", "1"}, {"_color", "255 255 255"}, {"_angle", "10 0"}})) +
        chunk("rLIT", dict({{"_type", "uni"}, {"_I", "0.25"}, {"_color", "255 255 255"}})) +
        chunk("rLEN", dict({{"_fov", "60"}, {"_exp", "-1"}})) +
        chunk("rDIS", dict({{"_gd_color", "0 0 0"}, {"_bg_color", "0 0 0"}})));
    EXPECT_FLOAT_EQ(scene.sun.elevation_deg, 10.0f);
    EXPECT_NEAR(glm::length(glm::vec2(scene.sun.direction()) - glm::vec2(0.0f, -cos_deg(10.0))), 0.0f, 1e-6f);
    EXPECT_EQ(scene.sky.radiance, glm::vec3(0.25f));
    EXPECT_EQ(scene.framing_fov_y_deg, 60.0);
    EXPECT_EQ(scene.exposure_ev, -1.0f);
    EXPECT_TRUE(scene.ground.on);
}

TEST(VoxSettings, hostile_values_are_held_to_their_ranges) {
    const Scene scene = scene_of(
        object({{"_type", "_inf"},
                {"_i", "1e308"},
                {"_k", "-5 nan 9999"},
                {"_angle", "1e9 -1e9"},
                {"_area", "-1"}}) +
        object({{"_type", "_uni"}, {"_i", "inf"}}) + object({{"_type", "_lens"}, {"_fov", "0"}}) +
        object({{"_type", "_film"}, {"_expo", "-3"}}) + object({{"_type", std::string(100000, 'x')}}) +
        object({{"", ""}}) + chunk("rLIT", "zzz") + chunk("rLEN", u32(0xFFFFFFFF)));
    EXPECT_EQ(scene.sun.elevation_deg, 90.0f);
    EXPECT_LE(scene.sun.irradiance.x, 1e6f);
    EXPECT_EQ(scene.framing_fov_y_deg, 1.0);
    EXPECT_TRUE(std::isfinite(scene.exposure_ev.value()));
    EXPECT_FALSE(scene.warnings.empty());
    std::string many;
    for (int i = 0; i < 2000; ++i)
        many += object({{"_type", "_ibl"}}) + record("rCAM", i, {{"_radius", "5"}});
    const auto file = read_vox(vox_builder::file(chiral_model(2, 2, 2) + many));
    EXPECT_EQ(render_objects(file.value()).size(), kVoxMaxObjects);
    EXPECT_EQ(saved_cameras(file.value()).size(), kVoxMaxCameras);
}

SavedCamera camera_of_pairs(const Pairs& pairs) {
    const auto file = read_vox(vox_builder::file(chiral_model(2, 2, 2) + record("rCAM", 4, pairs)));
    const std::vector<SavedCamera> cameras = saved_cameras(file.value());
    EXPECT_EQ(cameras.size(), 1u);
    return cameras.empty() ? SavedCamera{} : cameras[0];
}

TEST(VoxCameras, stand_behind_their_focus) {
    const SavedCamera front = camera_of_pairs(
        {{"_mode", "pers"}, {"_focus", "1 2 3"}, {"_angle", "0 0 0"}, {"_radius", "10"}, {"_fov", "60"}});
    EXPECT_EQ(front.name, "4");
    EXPECT_LT(glm::length(front.camera.position - glm::dvec3(1, -8, 3)), 1e-12);
    EXPECT_EQ(front.camera.yaw_deg, 90.0);
    EXPECT_EQ(front.camera.fov_y_deg, 60.0);
    const SavedCamera above = camera_of_pairs({{"_focus", "0 0 0"}, {"_angle", "90 0 0"}, {"_radius", "7"}});
    EXPECT_LT(glm::length(above.camera.position - glm::dvec3(0, 0, 7)), 1e-12)
        << "a pitch above 0 looks down";
    const SavedCamera left = camera_of_pairs({{"_focus", "0 0 0"}, {"_angle", "0 90 0"}, {"_radius", "7"}});
    EXPECT_LT(glm::length(left.camera.position - glm::dvec3(-7, 0, 0)), 1e-12) << "clockwise from the front";
}

TEST(VoxCameras, projections_and_unused_slots) {
    EXPECT_EQ(camera_of_pairs({{"_mode", "pano"}, {"_radius", "9"}}).camera.projection,
              Projection::equirectangular);
    const SavedCamera flat = camera_of_pairs({{"_mode", "orth"}, {"_radius", "9"}, {"_frustum", "40"}});
    EXPECT_EQ(flat.camera.projection, Projection::orthographic);
    EXPECT_EQ(flat.height, 40.0);
    for (const char* radius : {"0", "1"}) {
        const auto file = read_vox(vox_builder::file(
            chiral_model(2, 2, 2) +
            record("rCAM", 0, {{"_focus", "0 0 0"}, {"_angle", "0 0 0"}, {"_radius", radius}})));
        EXPECT_TRUE(saved_cameras(file.value()).empty()) << radius;
    }
    const Scene rolled =
        scene_of(record("rCAM", 3, {{"_angle", "0 0 20"}, {"_radius", "9"}, {"_mode", "sg"}}));
    EXPECT_EQ(rolled.notes.size(), 2u);
}

}  // namespace
}  // namespace voxilux
