// The colour spaces of FLIP (Andersson et al. 2020, section on the colour pipeline): sRGB primaries with the
// D65 white that (1,1,1) maps to, so that greys have no chroma at all.

#include "estimators/flip_colour.h"

#include <cmath>

namespace voxilux::flip_colour {
namespace {

using Mat3 = std::array<Vec3, 3>;

constexpr Mat3 kToXyz = {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                          {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                          {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};
constexpr Mat3 kFromXyz = {{{3.241003275, -1.537398934, -0.498615861},
                            {-0.969224334, 1.875930071, 0.041554224},
                            {0.055639423, -0.204011202, 1.057148933}}};
constexpr Vec3 kWhite = {0.950428545, 1.0, 1.088900371};

Vec3 multiply(const Mat3& m, const Vec3& v) {
    Vec3 result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return result;
}

double lab_curve(double t) {
    constexpr double kDelta = 6.0 / 29.0;  // CIE 15: where the cube root gives way to its tangent
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

}  // namespace

Vec3 opponent_of(const Vec3& rgb) {
    const Vec3 xyz = multiply(kToXyz, rgb);
    const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Vec3 rgb_of(const Vec3& opponent) {
    const double y = (opponent[0] + 16.0) / 116.0;
    const double x = y + opponent[1] / 500.0, z = y - opponent[2] / 200.0;
    return multiply(kFromXyz, {x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}

Vec3 hunt_lab_of(const Vec3& rgb) {
    const Vec3 xyz = multiply(kToXyz, rgb);
    const double x = lab_curve(xyz[0] / kWhite[0]), y = lab_curve(xyz[1] / kWhite[1]);
    const double z = lab_curve(xyz[2] / kWhite[2]);
    const double lightness = 116.0 * y - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)};
}

}  // namespace voxilux::flip_colour
