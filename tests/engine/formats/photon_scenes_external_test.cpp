// The scenes of photon mapping against the lists of spheres that the reference pictures were made from.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "formats/scene_toml.h"
#include "support/shared_data.h"

namespace voxilux {
namespace {

// A line: centre, radius, 0 diffuse or 1 mirror or 2 glass, colour, radiance, index of refraction; y is up.
struct ListedSphere {
    glm::dvec3 centre;
    double radius;
    int kind;
    glm::dvec3 colour;
    glm::dvec3 radiance;
    double ior;
};

std::vector<ListedSphere> listed_spheres(const std::string& name) {
    std::ifstream file(shared_data() / "data" / "reference" / ("scene_" + name + ".txt"));
    std::vector<ListedSphere> spheres;
    for (std::string line; std::getline(file, line);) {
        std::istringstream in(line);
        ListedSphere s{};
        in >> s.centre.x >> s.centre.y >> s.centre.z >> s.radius >> s.kind >> s.colour.x >> s.colour.y >>
            s.colour.z >> s.radiance.x >> s.radiance.y >> s.radiance.z >> s.ior;
        if (s.radius > 0.0) spheres.push_back(s);
    }
    return spheres;
}

Surface surface_of(const ListedSphere& listed) {
    if (listed.kind == 1) return Surface::metal;
    if (listed.kind == 2) return Surface::glass;
    return listed.radiance == glm::dvec3(0.0) ? Surface::diffuse : Surface::emit;
}

// The number of spheres that differ; numbers are compared to the bit.
int differing_spheres(const Scene& scene, const std::vector<ListedSphere>& listed) {
    int differing = 0;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const ListedSphere& want = listed[i];
        const Sphere& got = scene.spheres.at(i);
        const Material& material = scene.materials.at(got.material);
        const bool same = got.centre == glm::dvec3(want.centre.x, -want.centre.z, want.centre.y) &&
                          got.radius == want.radius && material.surface == surface_of(want) &&
                          material.albedo == glm::vec3(want.colour) &&
                          material.emission == glm::vec3(want.radiance) &&
                          material.ior == static_cast<float>(want.ior);
        differing += same ? 0 : 1;
    }
    return differing;
}

Scene scene_named(const std::string& name) {
    return load_scene(std::filesystem::path(VX_SOURCE_DIR) / "scenes" / (name + ".toml"));
}

class PhotonScenesExternal : public testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(PhotonScenesExternal, spheres_are_those_of_the_list_to_the_bit) {
    SKIP_WITHOUT_SHARED_DATA();
    const auto& [name, list] = GetParam();
    const std::vector<ListedSphere> listed = listed_spheres(list);
    Scene scene = scene_named(name);
    ASSERT_GE(listed.size(), 9u);
    ASSERT_EQ(scene.spheres.size(), listed.size());
    EXPECT_EQ(differing_spheres(scene, listed), 0);
    scene.spheres[3].centre.z += 1e-12;
    scene.materials[scene.spheres[5].material].albedo.y += 1e-6f;
    EXPECT_GE(differing_spheres(scene, listed), 1);
}

TEST_P(PhotonScenesExternal, camera_is_that_of_the_reference) {
    const Scene scene = scene_named(GetParam().first);
    ASSERT_TRUE(scene.camera);
    EXPECT_EQ(scene.camera->position, glm::dvec3(50, -295.6, 52));
    EXPECT_EQ(scene.camera->fov_y_deg, 30.0);
    EXPECT_NEAR(scene.camera->yaw_deg, 90.0, 1e-9);
    EXPECT_NEAR(std::tan(glm::radians(scene.camera->pitch_deg)), -0.042612, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(scenes, PhotonScenesExternal,
                         testing::Values(std::pair("cornell", "cornell"),
                                         std::pair("cornell_small_light", "cornell_small"),
                                         std::pair("large", "large"), std::pair("mirror", "mirror"),
                                         std::pair("surgery", "surgery"), std::pair("random", "random")),
                         [](const auto& test) { return test.param.first; });

}  // namespace
}  // namespace voxilux
