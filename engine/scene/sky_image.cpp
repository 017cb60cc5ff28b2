#include "scene/sky_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/colour.h"
#include "scene/alias_table.h"

namespace voxilux {
namespace {

constexpr double kPi = std::numbers::pi;

// The polar angle of the border above a row.
double border_of(glm::ivec2 size, int row) {
    return kPi * row / size.y;
}

// The integral of max(cos, 0) from 0 to an angle.
double lit_cosine(double angle) {
    const double turns = std::floor((angle + kPi / 2.0) / (2.0 * kPi));
    const double rest = angle - 2.0 * kPi * turns;  // [-pi/2, 3/2 pi)
    return 2.0 * turns + (rest < kPi / 2.0 ? std::sin(rest) : 1.0);
}

// The integrals over the polar angles of a row that the light of the faces consists of.
struct RowLight {
    double across = 0.0;  // of sin^2: times a face's cosine in azimuth
    double down = 0.0;    // of max(-cos, 0) sin
    double up = 0.0;      // of max(cos, 0) sin
};

RowLight row_light(glm::ivec2 size, int row) {
    const double top = border_of(size, row), bottom = border_of(size, row + 1);
    const auto half_square = [](double angle) { return 0.5 * std::sin(angle) * std::sin(angle); };
    const double middle = std::clamp(kPi / 2.0, top, bottom);
    return {.across = 0.5 * (bottom - top) - 0.25 * (std::sin(2.0 * bottom) - std::sin(2.0 * top)),
            .down = half_square(middle) - half_square(bottom),
            .up = half_square(middle) - half_square(top)};
}

// Of the azimuths of a column: the integrals of the cosines to -x, +x, -y and +y where they are above 0.
std::array<double, 4> column_light(const Sky& sky, int column) {
    const auto azimuth = [&](int border) {
        return kPi * (1.0 + double{sky.rotation_deg} / 180.0 - 2.0 * border / sky.image.size.x);
    };
    const double left = azimuth(column), right = azimuth(column + 1);
    std::array<double, 4> light{};
    for (std::size_t face = 0; face < light.size(); ++face) {
        constexpr std::array<double, 4> kTowards{kPi, 0.0, -kPi / 2.0, kPi / 2.0};
        light[face] = lit_cosine(left - kTowards[face]) - lit_cosine(right - kTowards[face]);
    }
    return light;
}

}  // namespace

glm::vec3 sky_texel_radiance(const Sky& sky, std::size_t texel) {
    return glm::min(sky.strength * sky.image.texels[texel], glm::vec3(kMaxRadiance));
}

bool has_light(const SkyImage& image) {
    return std::ranges::any_of(image.texels, [](const glm::vec3& texel) { return luminance(texel) > 0.0f; });
}

double sky_texel_solid_angle(glm::ivec2 size, int row) {
    const double middle = 0.5 * (border_of(size, row) + border_of(size, row + 1));
    return 2.0 * kPi / size.x * 2.0 * std::sin(middle) * std::sin(0.5 * kPi / size.y);
}

SkySampler sky_sampler(const Sky& sky) {
    const glm::ivec2 size = sky.image.size;
    const auto columns = static_cast<std::size_t>(size.x);
    std::vector<double> powers(sky.image.texels.size());
    for (std::size_t i = 0; i < powers.size(); ++i)
        powers[i] = double{luminance(sky_texel_radiance(sky, i))} *
                    sky_texel_solid_angle(size, static_cast<int>(i / columns));
    SkySampler sampler{.table = build_alias_table(powers)};
    sampler.texels.reserve(sampler.table.size());
    for (std::size_t i = 0; i < sampler.table.size(); ++i) {
        const double pdf =
            double{sampler.table[i].pdf} / sky_texel_solid_angle(size, static_cast<int>(i / columns));
        sampler.texels.emplace_back(sky_texel_radiance(sky, i), static_cast<float>(pdf));
    }
    return sampler;
}

std::array<glm::vec3, 6> sky_face_light(const Sky& sky) {
    const glm::ivec2 size = sky.image.size;
    std::vector<std::array<double, 4>> columns;
    for (int column = 0; column < size.x; ++column)
        columns.push_back(column_light(sky, column));
    std::array<glm::dvec3, 6> sums{};
    for (int row = 0; row < size.y && !sky.image.texels.empty(); ++row) {
        const RowLight own = row_light(size, row);
        for (int column = 0; column < size.x; ++column) {
            const auto texel = static_cast<std::size_t>(row) * static_cast<std::size_t>(size.x) +
                               static_cast<std::size_t>(column);
            const glm::dvec3 radiance(sky_texel_radiance(sky, texel));
            for (std::size_t face = 0; face < 4; ++face)
                sums[face] += own.across * columns[static_cast<std::size_t>(column)][face] * radiance;
            sums[4] += own.down * (2.0 * kPi / size.x) * radiance;
            sums[5] += own.up * (2.0 * kPi / size.x) * radiance;
        }
    }
    std::array<glm::vec3, 6> light{};
    for (std::size_t face = 0; face < 6; ++face)
        light[face] = glm::vec3(sums[face] / kPi);
    return light;
}

}  // namespace voxilux
