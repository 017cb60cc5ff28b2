#pragma once

// The C++ side of the sky's tables: what the passes sky.scatter, sky.view and sky.faces compute, with the
// same shared functions.

#include <cstdint>
#include <vector>

#include "shared/sky_view.h"

namespace voxilux::gpu {

inline uvec4 load_scatter(const std::vector<uvec4>& scatter, uint i) {
    return scatter[i];
}
inline float load_share(const std::vector<float>& shares, uint i) {
    return shares[i];
}
inline vec3 load_view(const std::vector<vec3>& view, uint i) {
    return view[i];
}

}  // namespace voxilux::gpu

#define VX_SKY_PARAM const std::vector<::voxilux::gpu::uvec4>&scatter,
#define VX_SKY_ARG scatter,
#define VX_VIEW_PARAM const std::vector<::voxilux::gpu::vec3>&view,
#define VX_VIEW_ARG view,
#define VX_SAMPLE_PARAM const std::vector<float>&shares,
#define VX_SAMPLE_ARG shares,
#include "shared/sky_lookup.h"
#include "shared/sky_sample.h"
#include "shared/sky_tables.h"
#undef VX_SKY_PARAM
#undef VX_SKY_ARG
#undef VX_VIEW_PARAM
#undef VX_VIEW_ARG
#undef VX_SAMPLE_PARAM
#undef VX_SAMPLE_ARG

namespace voxilux::test {

using ScatterTable = std::vector<glm::uvec4>;

// Rounds after the first.
inline ScatterTable scatter_table(const gpu::Air& air, gpu::uint rounds = gpu::kScatterRounds) {
    ScatterTable read(gpu::kScatterPairs, glm::uvec4(0));
    ScatterTable write(gpu::kScatterPairs);
    for (gpu::uint round = 0; round <= rounds; ++round) {
        for (gpu::uint i = 0; i < gpu::kScatterTexels; ++i) {
            const gpu::SkyHarmonics texel =
                gpu::scatter_texel(read, air, gpu::scatter_height(i / gpu::kScatterCosines),
                                   gpu::scatter_cosine(i % gpu::kScatterCosines), round == 0);
            for (gpu::uint pair = 0; pair < gpu::kTexelPairs; ++pair)
                write[gpu::kTexelPairs * i + pair] = gpu::scatter_pair(texel, pair);
        }
        std::swap(read, write);
    }
    return read;
}

inline std::vector<glm::vec3> view_table(const ScatterTable& scatter, const gpu::SkyParams& sky) {
    std::vector<glm::vec3> view;
    const gpu::uint columns = gpu::view_columns(sky.resolution);
    for (gpu::uint i = 0; i < gpu::view_texels(sky.resolution); ++i) {
        const gpu::ViewTexel texel = gpu::view_texel(scatter, sky, i / columns, i % columns);
        view.push_back(texel.light);
        view.push_back(texel.mie);
    }
    return view;
}

// The distributions of sky.columns and sky.rows.
inline std::vector<float> sky_shares(const std::vector<glm::vec3>& view, const gpu::SkyParams& sky) {
    std::vector<float> shares(gpu::kSkyShares);
    const auto sum_up = [&](std::size_t first, const auto& weight) {
        float total = 0.0f, sum = 0.0f;
        for (gpu::uint i = 0; i < gpu::kSkyBins; ++i)
            total += weight(i);
        for (gpu::uint i = 0; i < gpu::kSkyBins; ++i) {
            sum += weight(i);
            shares[first + i] = gpu::summed_share(sum, total, i);
        }
        return total;
    };
    for (gpu::uint face = 0; face < gpu::kFaceCount; ++face) {
        const std::size_t first = std::size_t{face} * gpu::kFaceShares;
        std::vector<float> totals(gpu::kSkyBins);
        for (gpu::uint row = 0; row < gpu::kSkyBins; ++row) {
            totals[row] = sum_up(first + gpu::kSkyBins * (1 + row), [&](gpu::uint column) {
                const glm::vec3 light =
                    gpu::sky_radiance(view, sky, gpu::bin_direction(row, column, glm::vec2(0.5f)));
                return gpu::bin_weight(face, row, column, light.x + light.y + light.z);
            });
        }
        (void)sum_up(first, [&](gpu::uint row) { return totals[row]; });
    }
    return shares;
}

// The march of a direction, per unit of the sun's irradiance: elevation and azimuth from the sun in degrees.
inline gpu::AirRay air_ray(const gpu::SkyParams& sky, double elevation_deg, double azimuth_deg) {
    const double to_radians = 3.14159265358979323846 / 180.0;
    const double sine = std::sin(elevation_deg * to_radians), cosine = std::cos(elevation_deg * to_radians);
    const auto sun = static_cast<double>(sky.sun_direction.z);
    const double horizontal = std::sqrt(std::max(1.0 - sun * sun, 0.0));
    return {sky.height, static_cast<float>(sine), sky.sun_direction.z,
            static_cast<float>(sine * sun + cosine * horizontal * std::cos(azimuth_deg * to_radians))};
}

inline glm::vec3 first_order(const gpu::SkyParams& sky, const gpu::AirRay& ray, const gpu::AirLight& light) {
    return light.rayleigh * gpu::rayleigh_phase(ray.sun_angle) +
           light.mie * gpu::mie_phase(sky.air.mie_g, ray.sun_angle);
}

// A unit direction by its azimuth and elevation in degrees.
inline glm::vec3 direction_of(double azimuth_deg, double elevation_deg) {
    const double to_radians = 3.14159265358979323846 / 180.0;
    const double cosine = std::cos(elevation_deg * to_radians);
    return {cosine * std::cos(azimuth_deg * to_radians), cosine * std::sin(azimuth_deg * to_radians),
            std::sin(elevation_deg * to_radians)};
}

// The radiance of the table in a direction at an azimuth from a sun over the x axis.
inline glm::vec3 looked_up(const std::vector<glm::vec3>& view, const gpu::SkyParams& sky,
                           double elevation_deg, double azimuth_deg) {
    return gpu::sky_radiance(view, sky, direction_of(azimuth_deg, elevation_deg));
}

}  // namespace voxilux::test
