// The pass sphere.trace: which of spheres and voxels each camera ray meets first, against double precision.

#include <gtest/gtest.h>

#include <limits>

#include "passes/plane.h"
#include "support/frame_fixture.h"
#include "support/march_probe.h"
#include "support/pixel_oracle.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

// Voxels. Float rounding of positions within 64 voxels of the camera, several times over.
constexpr double kPositionError = 1e-4;

// Spheres that rest on a floor, cross a wall, float, overlap, and lie inside a solid where nobody sees them.
Scene mixed_scene() {
    Scene scene = test::white_scene();
    test::add_box(scene, {-12, -12, -2}, {12, 12, 0});
    test::add_box(scene, {2, 4, 0}, {10, 6, 8});
    for (int i = 0; i < 5; ++i)
        scene.materials.push_back({.name = "ball", .albedo = glm::vec3(0.5f)});
    scene.spheres = {{glm::dvec3(-5, -2, 3), 3.0, 1},
                     {glm::dvec3(6, 4, 5), 2.25, 2},
                     {glm::dvec3(1, -8, 6.5), 1.5, 3},
                     {glm::dvec3(2, -8.5, 7), 1.25, 4},
                     {glm::dvec3(-6, 6, -1), 0.75, 5}};
    scene.settings.size = {64, 48};
    return scene;
}

// Distance along the unit direction to the first crossing of a sphere from outside, infinity when there is
// none.
double distance_to(const Sphere& sphere, glm::dvec3 origin, glm::dvec3 direction) {
    const glm::dvec3 from = origin - sphere.centre;
    const double b = glm::dot(from, direction) / glm::length(direction);
    const double square = b * b - (glm::dot(from, from) - sphere.radius * sphere.radius);
    const double t = -b - std::sqrt(square);
    return square >= 0.0 && t >= 0.0 ? t : std::numeric_limits<double>::infinity();
}

struct Judged {
    int spheres = 0;
    int voxels = 0;
    int wrong = 0;
};

// Compares each hit with the nearest sphere and the voxel hit of the same scene without spheres.
Judged judge(const Scene& scene, const std::vector<gpu::Hit>& hits) {
    Scene bare = scene;
    bare.spheres.clear();
    test::FrameFixture fixture(bare);
    const std::vector<gpu::Hit> voxels = fixture.render(0).hits;
    Judged judged;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const gpu::uint width = fixture.params().width;
        const test::DoubleRay ray = test::to_double(
            gpu::camera_ray(fixture.params(), static_cast<gpu::uint>(fixture.plan().projection),
                            sequence_id(scene.settings.sequence), static_cast<gpu::uint>(i) % width,
                            static_cast<gpu::uint>(i) / width));
        const glm::dvec3 origin = ray.origin + glm::dvec3(fixture.march_world().origin);
        double nearest = voxels[i].face == gpu::kFaceMiss ? std::numeric_limits<double>::infinity()
                                                          : static_cast<double>(voxels[i].t);
        std::size_t sphere = scene.spheres.size();
        for (std::size_t s = 0; s < scene.spheres.size(); ++s) {
            const double t = distance_to(scene.spheres[s], origin, ray.direction);
            if (std::abs(t - nearest) < kPositionError) nearest = -1.0;  // a tie: either is right
            if (t < nearest) sphere = s;
            nearest = std::min(nearest, t);
        }
        if (nearest < 0.0) continue;
        const gpu::Hit& hit = hits[i];
        if (sphere == scene.spheres.size()) {
            judged.voxels += hit.face <= 5u ? 1 : 0;
            judged.wrong += hit.face != voxels[i].face || hit.cell != voxels[i].cell ? 1 : 0;
            continue;
        }
        ++judged.spheres;
        const glm::dvec3 p = glm::dvec3(fixture.march_world().origin + hit.cell) + glm::dvec3(hit.fraction);
        const double off = glm::length(p - scene.spheres[sphere].centre) - scene.spheres[sphere].radius;
        const bool is_right = hit.face == gpu::kFaceSphere && hit.sphere == sphere &&
                              hit.material == scene.spheres[sphere].material &&
                              std::abs(off) < kPositionError &&
                              std::abs(static_cast<double>(hit.t) - nearest) < kPositionError;
        judged.wrong += is_right ? 0 : 1;
    }
    return judged;
}

TEST(SphereTrace, nearest_of_spheres_and_voxels_is_hit_at_every_pixel) {
    for (const glm::dvec3 eye : {glm::dvec3(12, -20, 14), {-18, 9, 6}, {0.5, -11, 25}, {3, 3, 9}}) {
        Scene scene = mixed_scene();
        scene.camera = test::camera_towards(eye, {1, 0, 2}, 60.0);
        const Judged judged = judge(scene, test::render_first_sample(scene).hits);
        EXPECT_GT(judged.spheres, 100);
        EXPECT_GT(judged.voxels, 100);
        // A ray within rounding of a silhouette may pass on either side.
        EXPECT_LE(judged.wrong, 2) << eye.x;
    }
}

TEST(SphereTrace, comparison_rejects_a_sphere_moved_by_a_thousandth_of_a_voxel) {
    Scene scene = mixed_scene();
    scene.camera = test::camera_towards({12, -20, 14}, {1, 0, 2}, 60.0);
    const std::vector<gpu::Hit> hits = test::render_first_sample(scene).hits;
    scene.spheres[0].centre.x += 1e-3;
    EXPECT_GT(judge(scene, hits).wrong, 10);
}

}  // namespace
}  // namespace voxilux
