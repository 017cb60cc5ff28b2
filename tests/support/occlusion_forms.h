#pragma once

// Closed forms for the fraction of cosine-weighted rays off a plane that meet an obstacle within a radius. By
// the Nusselt analogue such rays, seen from above, are uniform on the unit disc: direction (x, y, sqrt(1 -
// x^2 - y^2)), density 1 / pi. Obstacles become regions of that disc, and fractions become areas.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voxilux::test {

// Midpoint rule; square-root ends included, 20,000 intervals are right to 1e-7 and 500 to 1e-4.
template <class Function>
double integrate(double from, double to, const Function& f, int intervals = 20000) {
    if (!(to > from)) return 0.0;
    const double step = (to - from) / intervals;
    double sum = 0.0;
    for (int i = 0; i < intervals; ++i)
        sum += f(from + (i + 0.5) * step);
    return sum * step;
}

// An infinite wall along y, its foot at distance `d` > 0 in +x, of `height` above the plane. A ray meets it
// at t = d / x, so within `radius` where x > d / radius, and below its top where z t < height, that is y^2 >
// 1 - x^2 (1 + (height / d)^2).
inline double blocked_by_wall(double d, double height, double radius) {
    const double steepness = 1.0 + (height / d) * (height / d);
    const double area = integrate(std::min(1.0, d / radius), 1.0, [&](double x) {
        return 2.0 * (std::sqrt(1.0 - x * x) - std::sqrt(std::max(0.0, 1.0 - x * x * steepness)));
    });
    return area / std::numbers::pi;
}

// The floor of a slit along y between two walls of `height`, `d` from one of them. No ray meets both.
inline double blocked_in_slit(double d, double width, double height, double radius) {
    return blocked_by_wall(d, height, radius) + blocked_by_wall(width - d, height, radius);
}

// The fraction of the disc with x > a: what a wall without a top blocks, with a = d / radius.
inline double disc_segment(double a) {
    if (a >= 1.0) return 0.0;
    return (std::acos(a) - a * std::sqrt(1.0 - a * a)) / std::numbers::pi;
}

// Two walls without tops that meet at a right angle, `d1` and `d2` away: both segments less their overlap.
inline double blocked_in_corner(double d1, double d2, double radius) {
    const double a = d1 / radius;
    const double b = d2 / radius;
    const double both = integrate(a, std::sqrt(std::max(0.0, 1.0 - b * b)),
                                  [&](double x) { return std::max(0.0, std::sqrt(1.0 - x * x) - b); });
    return disc_segment(a) + disc_segment(b) - both / std::numbers::pi;
}

// A sphere of radius r that touches the plane, its foot `x` away: the form factor of a sphere wholly above
// the plane, (r / D)^2 cos = r^3 / D^3 with D^2 = x^2 + r^2. For rays without end.
inline double blocked_by_resting_sphere(double x, double r) {
    return std::pow(r * r / (x * x + r * r), 1.5);
}

}  // namespace voxilux::test
