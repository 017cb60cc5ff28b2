#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/colour.h"
#include "base/error.h"
#include "base/nearest_name.h"
#include "formats/scene_toml.h"
#include "scene/facts.h"
#include "scene/scene_camera.h"
#include "scene/scene_hash.h"

namespace voxilux {
namespace {

const char* const kWhite = "[material.white]\nalbedo = [1, 1, 1]\n";

TEST(SceneToml, all_settings_reach_the_scene) {
    const Scene scene = parse_scene(
        "[render]\nsize = [16384, 16]\nspp = 3\nao_rays = 5\nao_radius = 7.5\nseed = 4294967295\nsequence = "
        "\"halton\"\n"
        "[sun]\nazimuth = 10\nelevation = -20\nangular_diameter = 0\nirradiance = [1, 2, 3]\non = false\n"
        "[sky]\nradiance = [4, 5, 6]\n[camera]\nposition = [1, 2, 3]\nyaw = 30\npitch = -40\nfov = 50\n",
        "s.toml");
    EXPECT_EQ(scene.settings.size, glm::ivec2(16384, 16));
    EXPECT_EQ(scene.settings.spp, 3u);
    EXPECT_EQ(scene.settings.ao_rays, 5u);
    EXPECT_EQ(scene.settings.ao_radius, 7.5f);
    EXPECT_EQ(scene.settings.seed, 4294967295u);
    EXPECT_EQ(scene.settings.sequence, Sequence::halton);
    EXPECT_EQ(scene.sun.azimuth_deg, 10.0f);
    EXPECT_EQ(scene.sun.elevation_deg, -20.0f);
    EXPECT_EQ(scene.sun.angular_diameter_deg, 0.0f);
    EXPECT_EQ(scene.sun.irradiance, glm::vec3(1, 2, 3));
    EXPECT_FALSE(scene.sun.on);
    EXPECT_EQ(scene.sky.radiance, glm::vec3(4, 5, 6));
    ASSERT_TRUE(scene.camera);
    EXPECT_EQ(scene.camera->position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.camera->yaw_deg, 30.0);
    EXPECT_EQ(scene.camera->pitch_deg, -40.0);
    EXPECT_EQ(scene.camera->fov_y_deg, 50.0);
}

TEST(SceneToml, settings_of_photons_reach_the_scene) {
    const Scene scene = parse_scene(
        "[photons]\ncount = 16777216\nradius = 65536\nalpha = 1\nscatter = true\nclassic = true\n"
        "roulette = false\ndepth = 4096\n",
        "s.toml");
    EXPECT_EQ(scene.settings.photons, (PhotonSettings{.count = 16777216,
                                                      .radius = 65536.0,
                                                      .alpha = 1.0,
                                                      .scatter = true,
                                                      .classic = true,
                                                      .roulette = false,
                                                      .depth = 4096}));
    EXPECT_EQ(parse_scene("[photons]\n", "s.toml").settings.photons, PhotonSettings{});
}

TEST(SceneToml, empty_text_gives_the_defaults) {
    EXPECT_EQ(scene_hash(parse_scene("", "s.toml")), scene_hash(Scene{}));
    EXPECT_NE(scene_hash(parse_scene("[render]\nspp = 17\n", "s.toml")), scene_hash(Scene{}));
}

TEST(SceneToml, materials_get_the_defaults_of_their_surface) {
    const Scene scene = parse_scene(
        "[material.a]\ncolor = \"#ff8000\"\n[material.b]\nsurface = \"metal\"\n"
        "[material.c]\nsurface = \"glass\"\nior = 1\n[material.d]\nemission = [0, 2, 0]\n"
        "[material.e]\nemission = [0, 2, 0]\nsurface = \"diffuse\"\nroughness = 0.25\n",
        "s.toml");
    ASSERT_EQ(scene.materials.size(), 5u);
    // 0x80 is linear 0.21586 (IEC 61966-2-1: ((128/255 + 0.055) / 1.055)^2.4).
    EXPECT_NEAR(scene.materials[0].albedo.y, 0.215861f, 1e-6f);
    EXPECT_EQ(scene.materials[0].albedo.x, 1.0f);
    EXPECT_EQ(scene.materials[0].albedo.z, 0.0f);
    EXPECT_EQ(scene.materials[1].surface, Surface::metal);
    EXPECT_EQ(scene.materials[1].metallic, 1.0f);
    EXPECT_EQ(scene.materials[1].roughness, 0.0f);
    EXPECT_EQ(scene.materials[2].transmission, 1.0f);
    EXPECT_EQ(scene.materials[2].ior, 1.0f);
    EXPECT_EQ(scene.materials[3].surface, Surface::emit);
    EXPECT_EQ(scene.materials[4].surface, Surface::diffuse);
    EXPECT_EQ(scene.materials[4].emission, glm::vec3(0, 2, 0));
    EXPECT_EQ(scene.materials[4].roughness, 0.25f);
}

TEST(SceneToml, look_at_straight_down_has_north_up) {
    const Scene scene = parse_scene("[camera]\nposition = [3, 4, 9]\nlook_at = [3, 4, 0]\n", "s.toml");
    const glm::dmat3 basis = camera_basis(scene.camera.value());
    EXPECT_EQ(basis[0], glm::dvec3(1, 0, 0));
    EXPECT_EQ(basis[1], glm::dvec3(0, 1, 0));
    EXPECT_EQ(basis[2], glm::dvec3(0, 0, -1));
}

TEST(SceneToml, look_at_points_the_camera) {
    const Scene scene = parse_scene("[camera]\nposition = [1, 2, 3]\nlook_at = [4, -2, 15]\n", "s.toml");
    const glm::dvec3 forward = camera_basis(scene.camera.value())[2];
    const glm::dvec3 wanted(3.0 / 13, -4.0 / 13, 12.0 / 13);
    EXPECT_LT(glm::length(forward - wanted), 1e-15 * 4);  // a few roundings of numbers below 1
}

TEST(SceneToml, preset_frames_the_scene) {
    const std::string text =
        std::string(kWhite) +
        "[[shape]]\nshape = \"box\"\nfrom = [0,0,0]\nto = [9,5,7]\nmaterial = \"white\"\n"
        "[camera]\npreset = \"top\"\nfov = 30\n";
    const Scene scene = parse_scene(text, "s.toml");
    const Camera wanted = framing_camera({{0, 0, 0}, {9, 5, 7}}, View::top, 640.0 / 360.0, 30.0);
    ASSERT_TRUE(scene.camera);
    EXPECT_EQ(scene.camera->position, wanted.position);
    EXPECT_EQ(scene.camera->pitch_deg, -90.0);
    EXPECT_EQ(scene.camera->fov_y_deg, 30.0);
    EXPECT_FALSE(parse_scene(std::string(kWhite), "s.toml").camera);
}

TEST(SceneToml, lens_is_focused_on_the_middle_of_the_scene_unless_told_otherwise) {
    const std::string box =
        std::string(kWhite) +
        "[[shape]]\nshape = \"box\"\nfrom = [0,0,0]\nto = [9,5,7]\nmaterial = \"white\"\n";
    const auto lens_of = [&](const std::string& keys) {
        return parse_scene(box + "[camera]\n" + keys, "s.toml").lens;
    };
    EXPECT_EQ(lens_of("aperture = 2\n").focus_at, glm::dvec3(4.5, 2.5, 3.5));
    EXPECT_EQ(lens_of("aperture = 2\nfocus_at = [1, 2, 3]\n").focus_at, glm::dvec3(1, 2, 3));
    EXPECT_FALSE(lens_of("aperture = 2\nfocus = 9\n").focus_at);
    EXPECT_EQ(lens_of("aperture = 2\nblades = 6\n").blades, 6u);
    const Scene pinhole = parse_scene(box + "[camera]\naperture = 0\nfocus = 9\nblades = 6\n", "s.toml");
    EXPECT_EQ(scene_hash(pinhole), scene_hash(parse_scene(box, "s.toml"))) << "a pinhole has no focus";
    EXPECT_NE(scene_hash(pinhole), scene_hash(parse_scene(box + "[camera]\naperture = 1\n", "s.toml")));
}

TEST(SceneToml, pixels_per_voxel_make_a_sprite_unless_the_size_is_given) {
    const std::string box =
        std::string(kWhite) +
        "[[shape]]\nshape = \"box\"\nfrom = [0,0,0]\nto = [9,5,7]\nmaterial = \"white\"\n";
    const std::string camera = "[camera]\npreset = \"front\"\npixels_per_voxel = 4\n";
    const Scene scene = parse_scene(box + camera, "s.toml");
    EXPECT_EQ(scene.settings.size, glm::ivec2(36, 28));
    EXPECT_EQ(scene.camera->projection, Projection::orthographic);
    EXPECT_EQ(scene.camera->position, glm::dvec3(4.5, -1.0, 3.5));
    EXPECT_EQ(parse_scene(box + camera + "[render]\nsize = [50, 60]\n", "s.toml").settings.size,
              glm::ivec2(50, 60));
    const Scene fisheye = parse_scene("[camera]\nprojection = \"fisheye\"\nfov = 200\n", "s.toml");
    EXPECT_EQ(fisheye.camera->fov_y_deg, 200.0);
    EXPECT_EQ(fisheye.camera->projection, Projection::fisheye);
}

TEST(SceneTomlOverride, values_replace_and_add) {
    const std::string text =
        "[sun]\nelevation = 80\n[[sphere]]\ncenter = [0,0,0]\nradius = 1\nmaterial = \"a\"\n"
        "[material.a]\n";
    const Scene scene =
        parse_scene(text, "s.toml",
                    {.overrides = {"sun.elevation=10", "render.sequence=white", "sky.radiance=[1, 2, 3]",
                                   "sphere.0.radius=2.5", "material.b.color=\"#000000\"",
                                   "sphere.0.material=b", "sun.elevation=11"}});
    EXPECT_EQ(scene.sun.elevation_deg, 11.0f);
    EXPECT_EQ(scene.settings.sequence, Sequence::white);
    EXPECT_EQ(scene.sky.radiance, glm::vec3(1, 2, 3));
    ASSERT_EQ(scene.spheres.size(), 1u);
    EXPECT_EQ(scene.spheres[0].radius, 2.5);
    EXPECT_EQ(scene.materials.at(scene.spheres[0].material).albedo, glm::vec3(0.0f));
}

std::string contents_of(const std::filesystem::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

// Every scene of the repository loads, has its line on what it is for, and its expected plan.
TEST(SceneTomlFiles, all_load_and_explain_themselves) {
    namespace fs = std::filesystem;
    int count = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(VX_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".toml") continue;
        ++count;
        SCOPED_TRACE(entry.path().filename().string());
        const Scene scene = load_scene(entry.path());
        EXPECT_NO_THROW((void)measure_scene(scene));
        EXPECT_TRUE(scene.warnings.empty());
        const std::string text = contents_of(entry.path());
        EXPECT_EQ(text.substr(0, 2), "# ");
        EXPECT_NE(text.find("Plan: "), std::string::npos);
    }
    EXPECT_GE(count, 12);
}

// The example of scenes/README.md, less its .vox file, reads; and where it names defaults they are the
// defaults.
TEST(SceneTomlFiles, example_of_the_readme_is_true) {
    const std::string page = contents_of(std::filesystem::path(VX_SOURCE_DIR) / "scenes/README.md");
    const std::size_t from = page.find("```toml\n") + 8, to = page.find("```", from);
    ASSERT_NE(to, std::string::npos);
    std::string text = page.substr(from, to - from);
    const std::size_t model = text.find("[[model]]"), shape = text.find("[[shape]]");
    ASSERT_LT(model, shape);
    text.erase(model, shape - model);
    Scene scene = parse_scene(text, "README.md");
    EXPECT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(measure_scene(scene).voxel_count, 40u * 40u * 2u);
    EXPECT_EQ(scene.spheres.size(), 1u);
    const YawPitch direction = yaw_pitch_of(glm::dvec3(0, 0, 5) - glm::dvec3(40, -60, 30));
    EXPECT_NEAR(direction.yaw_deg, 123.7, 0.05);
    EXPECT_NEAR(direction.pitch_deg, -19.1, 0.05);
    scene.materials.clear();
    scene.models.clear();
    scene.instances.clear();
    scene.spheres.clear();
    scene.camera.reset();
    EXPECT_EQ(scene_hash(scene), scene_hash(Scene{}));
}

SceneFacts facts_of(const std::string& name) {
    return measure_scene(load_scene(std::filesystem::path(VX_SOURCE_DIR) / "scenes" / name));
}

TEST(SceneTomlFiles, facts_are_what_they_are_for) {
    EXPECT_FALSE(facts_of("empty.toml").has_voxels);
    EXPECT_EQ(facts_of("one_voxel.toml").voxel_count, 1u);
    EXPECT_FALSE(facts_of("night.toml").sun_reaches);
    EXPECT_FALSE(facts_of("overcast.toml").sun_reaches);
    EXPECT_FALSE(facts_of("black_sky.toml").has_sky);
    EXPECT_TRUE(facts_of("black_sky.toml").sun_reaches);
    EXPECT_FALSE(facts_of("spheres.toml").has_voxels);
    EXPECT_EQ(facts_of("spheres.toml").sphere_count, 3u);
    EXPECT_TRUE(facts_of("mixed.toml").has_voxels && facts_of("mixed.toml").has_spheres);
    EXPECT_TRUE(facts_of("emitters.toml").has_emitters);
    EXPECT_TRUE(facts_of("first_light.toml").sun_reaches);
    EXPECT_FALSE(facts_of("first_light.toml").has_emitters);
    // A floor of 512 x 512 and the slit of 65 x 256 x 17 less 256 x 16 cells.
    EXPECT_EQ(facts_of("plane.toml").voxel_count, 512u * 512u);
    EXPECT_EQ(facts_of("slit.toml").voxel_count, 65u * 256u * 17u - 256u * 16u);
}

TEST(NearestName, edit_distance_counts_operations) {
    EXPECT_EQ(edit_distance("", ""), 0u);
    EXPECT_EQ(edit_distance("sun", ""), 3u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
    EXPECT_EQ(edit_distance("elevation", "elevaton"), 1u);
    EXPECT_EQ(edit_distance("elevation", "elveation"), 1u);  // a swap
}

TEST(NearestName, hint_prefers_the_nearest) {
    const std::string_view names[] = {"position", "preset", "pitch"};
    EXPECT_EQ(nearest_name("pich", names), "pitch");
    EXPECT_EQ(nearest_name("postion", names), "position");
    EXPECT_EQ(nearest_name("quaternion", names), std::nullopt);
    EXPECT_EQ(nearest_name(std::string(1000, 'p'), names), std::nullopt);
}

}  // namespace
}  // namespace voxilux
