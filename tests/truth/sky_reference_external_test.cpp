// The technique `sky=reference`: paths through the air against radiances that another program has traced in
// double precision (sky_truth.cpp of the shared data).

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shared/sky_path.h"
#include "support/mean_colour.h"
#include "support/sky_model.h"
#include "truth/sky_oracle.h"

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec3;
using nlohmann::json;

// Of all comparisons: share that is off by more than three standard errors and a hundredth, and root of the
// mean square of the differences in standard errors.
struct Agreement {
    int compared = 0;
    int off = 0;
    double squares = 0.0;

    [[nodiscard]] double rms() const { return std::sqrt(squares / compared); }
};

test::MeanColour traced_mean(const gpu::SkyParams& sky, vec3 direction, gpu::uint stream, gpu::uint paths) {
    test::MeanColour mean;
    for (gpu::uint i = 0; i < paths; ++i)
        mean.add(gpu::traced_sky(sky, direction, gpu::air_noise({stream, i, 1}, 0)));
    return mean;
}

void compare(const test::MeanColour& found, const json& view, Agreement& agreement) {
    const bool is_ground = view.at("hits_ground").get<bool>();
    const dvec3 ground = is_ground ? test::colour_of(view.at("ground")) : dvec3(0.0);
    const dvec3 ground_error = is_ground ? test::colour_of(view.at("ground_se")) : dvec3(0.0);
    const dvec3 expected = test::colour_of(view.at("all")) + ground;
    const dvec3 error = test::colour_of(view.at("all_se"));
    for (int c = 0; c < 3; ++c) {
        const double away = std::abs(found.mean()[c] - expected[c]);
        const double deviation = std::hypot(found.error()[c], error[c], ground_error[c]);
        agreement.off += away > 3.0 * deviation + 0.01 * expected[c] ? 1 : 0;
        agreement.squares += away * away / (deviation * deviation);
        ++agreement.compared;
    }
}

// Every `step`-th direction of the cases whose sun is between these elevations.
Agreement agreement_of(double lowest_sun, double highest_sun, gpu::uint step, gpu::uint paths,
                       auto&& change) {
    Agreement agreement;
    gpu::uint number = 0;
    for (const json& row : test::sky_oracle().at("cases")) {
        const auto sun = row.at("sun_elevation_deg").get<double>();
        if (sun < lowest_sun || sun > highest_sun) continue;
        gpu::SkyParams sky = test::sky_at(row.at("altitude_km").get<double>(), sun);
        change(sky);
        for (const json& view : row.at("views")) {
            if (++number % step != 0) continue;
            const vec3 direction = test::direction_of(view.at("azimuth_deg").get<double>(),
                                                      view.at("elevation_deg").get<double>());
            compare(traced_mean(sky, direction, number, paths), view, agreement);
        }
    }
    return agreement;
}

constexpr auto kAsIs = [](gpu::SkyParams&) {};

// 3 in 1000 comparisons are off by more than three standard errors by chance, and a hundredth is allowed.
TEST(SkyReferenceExternal, every_tenth_direction_is_within_a_hundredth_and_three_standard_errors) {
    SKIP_WITHOUT_SHARED_DATA();
    const Agreement day = agreement_of(0.0, 90.0, 10, 4000, kAsIs);
    EXPECT_GT(day.compared, 150);
    EXPECT_EQ(day.off, 0);
    EXPECT_LT(day.rms(), 1.2);
    const Agreement dusk = agreement_of(-10.0, 0.0, 30, 12000, kAsIs);
    EXPECT_GT(dusk.compared, 20);
    EXPECT_EQ(dusk.off, 0);
}

TEST(SkyReferenceExternal, misprinted_aerosol_and_a_darker_ground_are_caught) {
    SKIP_WITHOUT_SHARED_DATA();
    const Agreement misprint = agreement_of(
        0.0, 90.0, 10, 2000, [](gpu::SkyParams& sky) { sky.air.mie_extinction = 3.996e-3f + 4.4e-3f; });
    EXPECT_GT(misprint.off, 20);
    const Agreement dark =
        agreement_of(40.0, 90.0, 10, 2000, [](gpu::SkyParams& sky) { sky.air.ground_albedo = 0.25f; });
    EXPECT_GT(dark.rms(), 3.0);
}

TEST(SkyReferenceNightlyExternal, every_direction_is_within_a_hundredth_and_three_standard_errors) {
    SKIP_WITHOUT_SHARED_DATA();
    for (const auto& [lowest, highest, paths] :
         {std::tuple{-10.0, 0.0, 100'000u}, {0.0, 5.0, 20'000u}, {5.0, 90.0, 10'000u}}) {
        const Agreement found = agreement_of(lowest, highest, 1, paths, kAsIs);
        fmt::print("sun {} to {} deg: {} of {} off, rms {:.3f} standard errors\n", lowest, highest, found.off,
                   found.compared, found.rms());
        EXPECT_EQ(found.off, 0);
        EXPECT_LT(found.rms(), 1.15);
    }
}

}  // namespace
}  // namespace voxilux
