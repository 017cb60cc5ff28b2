// Whole renders of analytic spheres against geometry: silhouettes, spheres on a floor, spheres as the floor.

#include <gtest/gtest.h>

#include <numbers>

#include "scene/scene_camera.h"
#include "support/frame_fixture.h"
#include "support/occlusion_forms.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

constexpr double kSphereSigmas = 4.0;

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

RenderOutcome render_with_aovs(const Scene& scene) {
    return test::render_validated(scene, {.plan = {.effects = {.wants_aov = true}}});
}

// Share of the picture that a sphere covers, seen under half angle b (sin b = radius / distance), g off the
// optical axis: on the plane at distance 1 the cone's section is an ellipse of area pi sin^2(b) cos(b) /
// (cos^2(g) - sin^2(b))^(3/2).
double silhouette_share(double b, double g, const Scene& scene) {
    const double half_height = std::tan(radians(scene.camera->fov_y_deg) / 2.0);
    const double aspect = static_cast<double>(scene.settings.size.x) / scene.settings.size.y;
    const double sine = std::sin(b);
    const double area =
        std::numbers::pi * sine * sine * std::cos(b) / std::pow(std::cos(g) * std::cos(g) - sine * sine, 1.5);
    return area / (4.0 * half_height * half_height * aspect);
}

Scene sphere_scene(glm::dvec3 centre, double radius) {
    Scene scene = test::white_scene();
    scene.spheres.push_back({centre, radius, 0});
    scene.camera = Camera{
        .position = glm::dvec3(0.25, -0.5, 0.125), .yaw_deg = 30.0, .pitch_deg = 12.0, .fov_y_deg = 60.0};
    scene.settings.size = {96, 64};
    scene.settings.spp = 16;
    return scene;
}

double mean_albedo(const Scene& scene) {
    double sum = 0.0;
    const std::vector<float> pixels = render_with_aovs(scene).image.channels.at("albedo.R").pixels;
    for (const float pixel : pixels)
        sum += static_cast<double>(pixel);
    return sum / static_cast<double>(pixels.size());
}

// The sphere's place in the camera's axes: `off` radians to the right of the optical axis.
glm::dvec3 beside_axis(const Scene& scene, double distance, double off) {
    const glm::dmat3 basis = camera_basis(*scene.camera);
    return scene.camera->position + distance * (std::sin(off) * basis[0] + std::cos(off) * basis[2]);
}

// Samples that cover the whole picture evenly have a smaller error than binomial ones, whose bound is used.
// The sphere is small or huge, near or far, on the axis and beside it.
TEST(AnalyticSphere, silhouette_has_the_area_of_the_closed_form) {
    for (const double radius : {0.25, 3.0, 1e5}) {
        for (const double off : {0.0, 0.45}) {
            const double b = 0.2;
            Scene scene = sphere_scene(glm::dvec3(0.0), radius);
            scene.spheres[0].centre = beside_axis(scene, radius / std::sin(b), off);
            const double share = silhouette_share(b, off, scene);
            const double samples = 96.0 * 64.0 * 16.0;
            const double bound = kSphereSigmas * std::sqrt(share * (1.0 - share) / samples);
            EXPECT_NEAR(mean_albedo(scene), share, bound) << radius << " " << off;
        }
    }
}

TEST(AnalyticSphere, silhouette_rejects_a_radius_off_by_a_tenth) {
    Scene scene = sphere_scene(glm::dvec3(0.0), 3.3);
    scene.spheres[0].centre = beside_axis(scene, 3.0 / std::sin(0.2), 0.0);
    const double share = silhouette_share(0.2, 0.0, scene);
    EXPECT_GT(std::abs(mean_albedo(scene) - share),
              2.0 * kSphereSigmas * std::sqrt(share * (1.0 - share) / (96.0 * 64.0 * 16.0)));
}

// A floor that is the top of a sphere at z = 0, seen from 6 voxels above it.
Scene sphere_floor(double radius) {
    Scene scene = test::white_scene();
    scene.materials.push_back({.name = "grey", .albedo = glm::vec3(0.5f)});
    scene.spheres.push_back({glm::dvec3(0.0, 0.0, -radius), radius, 0});
    scene.camera = test::camera_towards({0.0, -16.0, 6.0}, {0.0, 0.0, 1.0}, 50.0);
    scene.settings.size = {64, 48};
    scene.settings.spp = 4;
    scene.settings.ao_rays = 4;
    return scene;
}

// Voxels. Rounding of a position within 64 voxels of the camera, a few times over.
constexpr double kNearError = 64.0 * 8.0 * 0x1p-24;

TEST(AnalyticSphere, huge_sphere_as_a_floor_is_a_white_furnace_and_keeps_its_shape) {
    for (const double radius : {1e4, 1e5, 1e6}) {
        const Scene scene = sphere_floor(radius);
        const Image image = render_with_aovs(scene).image;
        double worst = 0.0;
        for (const float pixel : image.channels.at("R").pixels)
            ASSERT_EQ(pixel, 1.0f) << radius;
        const std::vector<float>& z = image.channels.at("Z").pixels;
        int near = 0;
        for (std::size_t i = 0; i < z.size(); ++i) {
            if (z[i] > 64.0f) continue;
            ++near;
            const glm::dvec3 p(image.channels.at("P.X").pixels[i], image.channels.at("P.Y").pixels[i],
                               image.channels.at("P.Z").pixels[i]);
            const double height = glm::length(p - scene.spheres[0].centre) - radius;
            worst = std::max(worst, std::abs(height));
        }
        EXPECT_LT(worst, kNearError) << radius;
        EXPECT_GT(near, 1000) << radius;
    }
}

// Where the horizon of a sphere of radius R lies, seen from h above it: acos(R / (R + h)) below the level.
TEST(AnalyticSphere, horizon_of_a_huge_sphere_dips_as_geometry_says) {
    for (const double radius : {1e4, 1e6}) {
        Scene scene = sphere_floor(radius);
        scene.camera = Camera{.position = glm::dvec3(0.0, 0.0, 6.0), .yaw_deg = 40.0, .fov_y_deg = 20.0};
        const double dip = std::acos(radius / (radius + 6.0));
        // The picture plane at distance 1: rows below -tan(dip) / cos(azimuth) see the sphere.
        const double half_height = std::tan(radians(10.0));
        const double half_width = half_height * 64.0 / 48.0;
        const double mean_rise =
            test::integrate(0.0, half_width,
                            [&](double x) { return std::tan(dip) * std::sqrt(1.0 + x * x); }) /
            half_width;
        const double share = 0.5 - 0.5 * mean_rise / half_height;
        EXPECT_NEAR(mean_albedo(scene), share, 2e-3) << radius;
    }
}

// A ball on the sphere's top against the closed form for a ball on a plane: over the 8 voxels that are
// compared, the floor falls by 64 / 2 R.
TEST(AnalyticSphere, ball_on_a_huge_sphere_darkens_it_as_on_a_plane) {
    for (const double radius : {1e5, 1e6}) {
        Scene scene = sphere_floor(radius);
        scene.spheres.push_back({glm::dvec3(0.0, 0.0, 3.0), 3.0, 1});
        scene.camera = test::camera_towards({0.0, -13.0, 9.0}, {0.0, -3.0, 0.0}, 30.0);
        scene.settings.ao_rays = 512;
        scene.settings.spp = 1;
        scene.settings.ao_radius = 1000.0f;
        const Image image = render_with_aovs(scene).image;
        double worst = 0.0;  // in binomial deviations
        int compared = 0;
        for (std::size_t i = 0; i < pixel_count(image); ++i) {
            const double x = image.channels.at("P.X").pixels[i];
            const double y = image.channels.at("P.Y").pixels[i];
            const bool is_floor = image.channels.at("albedo.R").pixels[i] == 1.0f;
            if (!is_floor || x * x + y * y > 64.0) continue;
            const double open = 1.0 - test::blocked_by_resting_sphere(std::hypot(x, y), 3.0);
            const double away = static_cast<double>(image.channels.at("ao.Y").pixels[i]) - open;
            worst = std::max(worst, std::abs(away) / std::sqrt(std::max(open * (1.0 - open), 1e-3) / 512.0));
            ++compared;
        }
        EXPECT_GT(compared, 500) << radius;
        EXPECT_LT(worst, 5.0) << radius;
    }
}

TEST(AnalyticSphere, sphere_on_a_voxel_floor_has_a_finite_contact_shadow) {
    Scene scene = test::white_scene();
    test::add_box(scene, {-30, -30, -1}, {30, 30, 0});
    scene.materials.push_back({.name = "grey", .albedo = glm::vec3(0.5f)});
    scene.spheres.push_back({glm::dvec3(0.0, 0.0, 4.0), 4.0, 1});
    scene.sun = {.azimuth_deg = 200.0f, .elevation_deg = 50.0f, .angular_diameter_deg = 2.0f};
    scene.camera = test::camera_towards({0.0, -12.0, 1.0}, {0.0, 0.0, 0.2}, 20.0);
    scene.settings.size = {80, 60};
    scene.settings.spp = 8;
    scene.settings.ao_rays = 8;
    const Image image = render_with_aovs(scene).image;
    for (const auto& [name, channel] : image.channels) {
        for (const float pixel : channel.pixels)
            ASSERT_TRUE(std::isfinite(pixel)) << name;
    }
    const std::vector<float>& ao = image.channels.at("ao.Y").pixels;
    EXPECT_LT(*std::ranges::min_element(ao), 0.1f) << "the contact is dark";
    EXPECT_GT(*std::ranges::max_element(ao), 0.9f);
    for (const float open : ao)
        ASSERT_TRUE(open >= 0.0f && open <= 1.0f) << open;
}

}  // namespace
}  // namespace voxilux
