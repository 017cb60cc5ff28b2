// Photons of caustics alone: those that start towards mirrors and glass against those that start anywhere.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "frame/frame.h"
#include "passes/upload.h"
#include "renderer/prepared_scene.h"
#include "shared/counters.h"
#include "shared/light.h"
#include "shared/photon_aim.h"
#include "support/device_fixture.h"
#include "support/light_scenes.h"

namespace voxilux {
namespace {

// A floor seen from above, and nothing that finds light but photons of caustics.
Scene floor_scene(std::uint32_t photons) {
    Scene scene = test::dark_scene(32, photons, 1.0);
    scene.settings.photons.indirect = false;
    scene.settings.sequence = Sequence::white;
    test::add_box(scene, {-12, -12, -1}, {12, 12, 0}, test::add_diffuse(scene, 0.8f));
    scene.camera = test::camera_towards({0.5, -1.0, 40.0}, {0.5, 0.0, 0.0}, 32.0);
    return scene;
}

Scene ball_in_sunlight() {
    Scene scene = floor_scene(4096);
    scene.sun = {.azimuth_deg = 30.0f, .elevation_deg = 50.0f, .angular_diameter_deg = 0.53f};
    scene.spheres = {{{1.0, 2.0, 3.0}, 2.0, test::add_glass(scene, 1.5f)}};
    return scene;
}

// The axes of the disc turn with the direction: a sun as wide as a hand.
Scene ball_in_wide_sunlight() {
    Scene scene = ball_in_sunlight();
    scene.sun.angular_diameter_deg = 40.0f;
    return scene;
}

Scene voxels_of_mirror_in_sunlight() {
    Scene scene = floor_scene(4096);
    scene.sun = {.azimuth_deg = 200.0f, .elevation_deg = 60.0f};
    const std::uint16_t mirror = test::add_mirror(scene, 0.9f);
    test::add_box(scene, {-4, -2, 0}, {-3, 3, 4}, mirror);
    test::add_box(scene, {5, 5, 0}, {6, 6, 2}, mirror);
    return scene;
}

// Emitters of both kinds, one of them coloured, one with glass before its face.
Scene emitters_between_specular_things() {
    Scene scene = floor_scene(8192);
    const std::uint16_t glass = test::add_glass(scene, 1.4f, 0.95f);
    test::add_box(scene, {-6, 4, 5}, {-4, 6, 6}, test::add_emitter(scene, 20.0f));
    test::add_box(scene, {-6, 4, 4}, {-5, 5, 5}, glass);
    test::add_box(scene, {6, -4, 0}, {7, 1, 4}, test::add_mirror(scene));
    const std::uint16_t orange = test::add_emitter(scene, 10.0f);
    scene.materials[orange].emission.z = 2.0f;
    scene.spheres = {{{2.0, -6.0, 5.0}, 1.0, orange}, {{-1.0, -3.0, 2.5}, 1.5, glass}};
    return scene;
}

Scene one_voxel_far_from_its_emitter() {
    Scene scene = floor_scene(16384);
    test::add_box(scene, {0, 0, 2}, {1, 1, 3}, test::add_mirror(scene));
    test::add_box(scene, {9, 0, 11}, {10, 1, 12}, test::add_emitter(scene, 300.0f));
    return scene;
}

// All that meets the voxel arrives on the floor behind it, where the camera looks: pixels are so narrow that
// it matters little where in them their points lie.
Scene voxel_of_glass_far_from_its_emitter() {
    Scene scene = floor_scene(65536);
    test::add_box(scene, {0, 0, 2}, {1, 1, 3}, test::add_glass(scene, 1.2f));
    test::add_box(scene, {6, 0, 14}, {7, 1, 15}, test::add_emitter(scene, 300.0f));
    scene.camera = test::camera_towards({-0.8, -8.0, 20.0}, {-0.8, 0.5, 0.0}, 16.0);
    return scene;
}

constexpr std::uint32_t kIterations = 32;

using Change = std::function<void(PreparedScene&)>;

// The mean of samples, and its variance.
struct Mean {
    double value = 0.0;
    double variance = 0.0;
};

Mean mean_of(const std::vector<double>& samples) {
    const auto n = static_cast<double>(samples.size());
    Mean mean{.value = std::accumulate(samples.begin(), samples.end(), 0.0) / n};
    for (const double sample : samples)
        mean.variance += (sample - mean.value) * (sample - mean.value) / (n * (n - 1.0));
    return mean;
}

// How far two series are apart, in standard deviations. Samples of a number have the same visible points.
double deviations(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < a.size(); ++i)
        differences.push_back(a[i] - b.at(i));
    const Mean mean = mean_of(differences);
    return mean.value / std::sqrt(mean.variance);
}

double brightness_of(const std::vector<gpu::vec3>& values, std::size_t count) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i)
        sum += static_cast<double>(gpu::brightness(values[i]));
    return sum;
}

// Runs iterations of the prepared scene and hands out what a buffer holds after each.
template <class T>
void run_iterations(const Scene& scene, const PreparedScene& prepared, const std::string& buffer,
                    std::uint32_t iterations, const std::function<void(const std::vector<T>&)>& take) {
    const RenderPlan& plan = prepared.plan;
    Recording upload;
    record_scene_upload(plan, scene, prepared.march_world, prepared.lights, upload);
    record_film_clear(plan, upload);
    test_executor().run(upload);
    const gpu::FrameParams params = frame_params(plan, scene, prepared.march_world);
    for (std::uint32_t i = 0; i < iterations; ++i) {
        Recording recording;
        record_frame(plan, {.row_count = plan.film_tile_rows}, params, {.sample = i, .state = {}}, recording);
        recording.readback(buffer);
        recording.readback("counters");
        const RunResult result = test_executor().run(recording);
        const std::vector<gpu::uint> counters = values_of<gpu::uint>(result, "counters");
        for (std::size_t fault = 0; fault < gpu::kFaultCount; ++fault)
            EXPECT_EQ(counters[fault], 0u) << gpu::kCounterNames[fault];
        take(values_of<T>(result, buffer));
    }
}

PreparedScene prepared_for(const Scene& scene, const Change& change) {
    PreparedScene prepared = prepare_scene(scene, {}, test_device().limits());
    if (change) change(prepared);
    return prepared;
}

// The light of caustics over the picture in each iteration.
std::vector<double> caustic_light(Scene scene, bool aim, const Change& change = {}) {
    scene.settings.photons.aim = aim;
    const PreparedScene prepared = prepared_for(scene, change);
    EXPECT_EQ(prepared.plan.photons.aims, aim);
    std::vector<double> samples;
    run_iterations<gpu::vec3>(scene, prepared, "photon.light", kIterations,
                              [&](const std::vector<gpu::vec3>& light) {
                                  samples.push_back(brightness_of(light, prepared.plan.tile_pixels()));
                              });
    return samples;
}

struct AimCase {
    std::string name;
    Scene (*scene)();
    double least_gain;  // in the variance of the mean
};
void PrintTo(const AimCase& one, std::ostream* out) {
    *out << one.name;
}

class PhotonAim : public testing::TestWithParam<AimCase> {};

TEST_P(PhotonAim, changes_the_noise_of_caustics_and_not_their_mean) {
    const std::vector<double> aimed = caustic_light(GetParam().scene(), true);
    const std::vector<double> anywhere = caustic_light(GetParam().scene(), false);
    EXPECT_GT(mean_of(anywhere).value, 0.0);
    EXPECT_LT(std::abs(deviations(aimed, anywhere)), 3.0)
        << mean_of(aimed).value << ' ' << mean_of(anywhere).value;
    const double gain = mean_of(anywhere).variance / mean_of(aimed).variance;
    EXPECT_GT(gain, GetParam().least_gain);
    RecordProperty("deviations", std::to_string(deviations(aimed, anywhere)));
    RecordProperty("gain", std::to_string(gain));
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, PhotonAim,
    testing::Values(AimCase{"ball_in_sunlight", ball_in_sunlight, 4.0},
                    AimCase{"ball_in_wide_sunlight", ball_in_wide_sunlight, 2.0},
                    AimCase{"voxels_of_mirror_in_sunlight", voxels_of_mirror_in_sunlight, 2.0},
                    AimCase{"emitters_between_specular_things", emitters_between_specular_things, 1.2},
                    AimCase{"voxel_of_glass_far_from_its_emitter", voxel_of_glass_far_from_its_emitter, 8.0},
                    AimCase{"one_voxel_far_from_its_emitter", one_voxel_far_from_its_emitter, 20.0}),
    [](const auto& tested) { return tested.param.name; });

// The negative control: one cell is taken out of each map. All other photons are the same, so what the cell
// carries shows, though it is a hundredth of all.
TEST(PhotonAimTwinNightly, map_without_one_of_its_cells_is_caught) {
    const auto lose_a_cell = [](PreparedScene& prepared) {
        PhotonAims& aims = prepared.lights.aims;
        for (gpu::AimMap& map : aims.maps) {
            if (map.count < 2) continue;
            // Another cell takes its place, half a turn away, where nothing bends or mirrors light.
            const gpu::uint lost = map.count / 2;
            gpu::AimCell cell = gpu::unpack_aim_cell(aims.cells[map.first + lost]);
            cell.column = (cell.column + 64u) % 128u;
            aims.cells[map.first + lost] = gpu::pack_aim_cell(cell);
        }
    };
    const std::vector<double> whole = caustic_light(voxel_of_glass_far_from_its_emitter(), true);
    const std::vector<double> without =
        caustic_light(voxel_of_glass_far_from_its_emitter(), true, lose_a_cell);
    EXPECT_GT(deviations(whole, without), 3.0) << mean_of(whole).value << ' ' << mean_of(without).value;
}

// The power of all photons of an iteration, as the device emits them.
double emitted_power(const Scene& scene, const PreparedScene& prepared) {
    double power = 0.0;
    run_iterations<gpu::PhotonStart>(scene, prepared, "photon.rays", 1,
                                     [&](const std::vector<gpu::PhotonStart>& starts) {
                                         for (const gpu::PhotonStart& start : starts)
                                             power += static_cast<double>(gpu::brightness(start.power));
                                     });
    return power;
}

// What is carried and what is left out are the power of all light: by the true areas, radiances and the disc.
TEST(PhotonAimPowerNightly, carried_and_left_out_is_that_of_all_lights) {
    for (const auto make : {ball_in_sunlight, emitters_between_specular_things}) {
        Scene scene = make();
        const PreparedScene aimed = prepared_for(scene, {});
        scene.settings.photons.aim = false;
        const PreparedScene anywhere = prepared_for(scene, {});
        ASSERT_TRUE(aimed.plan.photons.aims);
        EXPECT_EQ(anywhere.plan.photons.power_left_out, 0.0);
        EXPECT_GT(aimed.plan.photons.power_left_out, 0.3 * anywhere.plan.photons.power);
        EXPECT_NEAR(aimed.plan.photons.power + aimed.plan.photons.power_left_out, anywhere.plan.photons.power,
                    1e-12 * anywhere.plan.photons.power);
        // Emitters are drawn by float probabilities, within 2^-24 each.
        EXPECT_NEAR(emitted_power(scene, anywhere), anywhere.plan.photons.power,
                    1e-4 * anywhere.plan.photons.power);
        scene.settings.photons.aim = true;
        EXPECT_NEAR(emitted_power(scene, aimed), aimed.plan.photons.power, 1e-4 * aimed.plan.photons.power);
    }
    constexpr double kPi = 3.14159265358979;
    const PreparedScene lit = prepared_for(emitters_between_specular_things(), {});
    // Faces of four voxels of radiance 20 but for those that touch another one, and a ball of radius 1.
    const double faces = 16.0 * 60.0 * kPi, ball = 22.0 * 4.0 * kPi * kPi;
    EXPECT_NEAR(lit.plan.photons.power + lit.plan.photons.power_left_out, faces + ball,
                1e-5 * (faces + ball));
}

TEST(PhotonAimHardCase, without_a_target_no_photon_runs) {
    Scene scene = floor_scene(4096);
    scene.settings.photons.radius.reset();  // nor a pilot
    // The mirror lies behind the one face that shines: a lid of diffuse voxels covers the others.
    test::add_box(scene, {-1, -1, 3}, {2, 2, 5}, 0);
    const std::uint16_t lamp = test::add_emitter(scene, 5.0f);
    test::add_box(scene, {0, 0, 3}, {1, 1, 4}, lamp);
    test::add_box(scene, {0, 0, 8}, {1, 1, 9}, test::add_mirror(scene));
    const PreparedScene prepared = prepared_for(scene, {});
    EXPECT_TRUE(prepared.plan.is_by_photons(Effect::caustics));
    EXPECT_GT(prepared.plan.world.lights.power, 0.0);
    EXPECT_FALSE(prepared.plan.photons.runs());
    EXPECT_FALSE(prepared.plan.needs_pilot());
    Recording recording;
    record_frame(prepared.plan, {.row_count = prepared.plan.film_tile_rows},
                 frame_params(prepared.plan, scene, prepared.march_world), {.sample = 0, .state = {}},
                 recording);
    EXPECT_EQ(recording.find("photon.rays"), nullptr);
    EXPECT_EQ(recording.find("photon.aim_cells"), nullptr);
}

TEST(PhotonAimHardCase, emitter_within_glass_keeps_photons_that_start_anywhere) {
    Scene scene = floor_scene(4096);
    test::add_box(scene, {0, 0, 3}, {1, 1, 4}, test::add_emitter(scene, 5.0f));
    scene.spheres = {{{0.5, 0.5, 4.5}, 3.0, test::add_glass(scene, 1.5f)}};
    const PreparedScene prepared = prepared_for(scene, {});
    EXPECT_TRUE(prepared.plan.world.lights.aims.has_value());
    EXPECT_TRUE(prepared.plan.photons.runs());
    EXPECT_FALSE(prepared.plan.photons.aims);
}

// Photons that serve indirect light, too, are left alone.
TEST(PhotonAimHardCase, photons_of_indirect_light_are_aimed_nowhere) {
    Scene scene = emitters_between_specular_things();
    scene.settings.photons.indirect = true;
    const PreparedScene prepared = prepared_for(scene, {});
    EXPECT_TRUE(prepared.plan.is_by_photons(Effect::indirect));
    EXPECT_FALSE(prepared.plan.photons.aims);
    EXPECT_TRUE(prepared.lights.aims.maps.empty());
}

}  // namespace
}  // namespace voxilux
