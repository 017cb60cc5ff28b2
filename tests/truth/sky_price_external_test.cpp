// What accuracy of the sky costs: errors of its tables by their size, the steps of a march and the rounds of
// gathering, against radiances that another program has traced in double precision (sky_truth.cpp of the
// shared data). Prints the price list of scenes/README.md.

#include <array>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/stopwatch.h"
#include "support/sky_model.h"
#include "truth/sky_oracle.h"

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec3;
using nlohmann::json;

// Relative errors over directions above the horizon, by the sun: at 10 degrees or more, at 0.5 and 2, below.
struct SkyErrors {
    struct Mean {
        dvec3 sum{0.0}, squares{0.0};
        double count = 0.0;
    };
    std::array<Mean, 3> by_sun;

    void add(double sun_deg, vec3 found, dvec3 expected) {
        Mean& mean = by_sun.at(sun_deg >= 10.0 ? 0 : sun_deg > 0.0 ? 1 : 2);
        const dvec3 error = dvec3(found) / expected - 1.0;
        mean.sum += error;
        mean.squares += error * error;
        mean.count += 1.0;
    }
    [[nodiscard]] dvec3 rms_percent(std::size_t sun) const {
        return 100.0 * glm::sqrt(by_sun.at(sun).squares / by_sun.at(sun).count);
    }
    [[nodiscard]] dvec3 bias_percent(std::size_t sun) const {
        return 100.0 * by_sun.at(sun).sum / by_sun.at(sun).count;
    }
};

// found(sky) gives a function of a view.
SkyErrors errors_of(const auto& found) {
    SkyErrors errors;
    for (const json& row : test::sky_oracle().at("cases")) {
        const auto sun = row.at("sun_elevation_deg").get<double>();
        const auto radiance = found(test::sky_at(row.at("altitude_km").get<double>(), sun));
        for (const json& view : row.at("views")) {
            if (view.at("hits_ground").get<bool>()) continue;
            errors.add(sun,
                       radiance(view.at("elevation_deg").get<double>(), view.at("azimuth_deg").get<double>()),
                       test::colour_of(view.at("all")));
        }
    }
    return errors;
}

void print(const std::string& name, const SkyErrors& errors, double milliseconds) {
    fmt::print("| {} |", name);
    for (std::size_t sun = 0; sun < 3; ++sun) {
        const dvec3 rms = errors.rms_percent(sun), bias = errors.bias_percent(sun);
        fmt::print(" {:.1f} {:.1f} {:.1f} ({:+.1f} {:+.1f} {:+.1f}) |", rms.x, rms.y, rms.z, bias.x, bias.y,
                   bias.z);
    }
    fmt::print(" {:.0f} |\n", milliseconds);
}

// By the table of the sky.
SkyErrors errors_of_table(const test::ScatterTable& scatter, gpu::uint resolution) {
    return errors_of([&](gpu::SkyParams sky) {
        sky.resolution = resolution;
        return [sky, view = test::view_table(scatter, sky)](double elevation, double azimuth) {
            return test::looked_up(view, sky, elevation, azimuth);
        };
    });
}

// By a march of each direction.
SkyErrors errors_of_march(const test::ScatterTable& scatter, gpu::uint panels) {
    return errors_of([&](const gpu::SkyParams& sky) {
        return [&scatter, sky, panels](double elevation, double azimuth) {
            const gpu::AirRay ray = test::air_ray(sky, elevation, azimuth);
            const gpu::AirLight light = gpu::march_air(scatter, sky.air, ray, panels, true);
            return test::first_order(sky, ray, light) + light.multiple;
        };
    });
}

const gpu::Air& air() {
    static const gpu::Air earth = test::sky_at(0.0, 0.0).air;
    return earth;
}

TEST(SkyPriceExternal, errors_fall_with_size_steps_and_rounds) {
    SKIP_WITHOUT_SHARED_DATA();
    fmt::print(
        "rms (mean) error in %, red green blue: sun at 10 degrees or more | 0.5 and 2 | below | "
        "ms of one thread\n");
    const auto timed = [](const std::string& name, const auto& make) {
        const Stopwatch clock;
        const SkyErrors errors = make();
        print(name, errors, 1e3 * clock.elapsed().cpu);
        return errors;
    };
    const test::ScatterTable usual = test::scatter_table(air());
    std::vector<SkyErrors> sizes, rounds, steps;
    for (const gpu::uint resolution : {16u, 32u, 64u, 128u})
        sizes.push_back(
            timed(fmt::format("rows {}", resolution), [&] { return errors_of_table(usual, resolution); }));
    for (const gpu::uint round : {0u, 1u, 2u, 4u, 8u}) {
        const test::ScatterTable table = test::scatter_table(air(), round);
        rounds.push_back(timed(fmt::format("rounds {}", round), [&] { return errors_of_march(table, 4); }));
    }
    for (const gpu::uint panels : {1u, 2u, 4u, 8u})
        steps.push_back(
            timed(fmt::format("steps {}", 6 * panels), [&] { return errors_of_march(usual, panels); }));
    for (std::size_t sun = 0; sun < 3; ++sun) {
        EXPECT_GT(sizes.front().rms_percent(sun).x, sizes.back().rms_percent(sun).x) << sun;
        EXPECT_GT(rounds.front().rms_percent(sun).z, 1.5 * rounds.back().rms_percent(sun).z) << sun;
        EXPECT_GE(steps.front().rms_percent(sun).x, 0.95 * steps.back().rms_percent(sun).x) << sun;
    }
}

}  // namespace
}  // namespace voxilux
