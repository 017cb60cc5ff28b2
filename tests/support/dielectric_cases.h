#pragma once

// Rays at surfaces between media, and Fresnel's equations in long double.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "support/statistics.h"

namespace voxilux::test {

struct DielectricCase {
    float cosine;  // of the angle of incidence; near the critical angle or grazing in half of the cases
    float eta;     // n_far / n_near, in [1/4, 4]
    glm::vec3 direction;  // unit; its angle to the normal is another one
    glm::vec3 normal;     // unit, against the direction
};

inline std::array<float, 14> hostile_floats() {
    const float inf = std::numeric_limits<float>::infinity();
    return {0.0f, -0.0f, 1.0f,          -1.0f, 1e-30f, 1e-42f, 1e30f,
            inf,  -inf,  std::nanf(""), 0.5f,  1.5f,   2.0f,   -3.0f};
}

inline glm::vec3 random_float_unit(TestRandom& random) {
    const double z = random.uniform(-1.0, 1.0), azimuth = random.uniform(0.0, 6.283185307179586);
    const double across = std::sqrt(1.0 - z * z);
    return glm::vec3(glm::dvec3(across * std::cos(azimuth), across * std::sin(azimuth), z));
}

inline std::vector<DielectricCase> dielectric_cases(int count) {
    TestRandom random(31);
    std::vector<DielectricCase> cases;
    for (int i = 0; i < count; ++i) {
        DielectricCase c{};
        c.eta = static_cast<float>(std::exp2(random.uniform(-2.0, 2.0)));
        if (i % 8 == 7) c.eta = 1.0f + static_cast<float>(random.uniform(-4.0, 4.0)) * 0x1p-23f;
        c.cosine = static_cast<float>(random.uniform(0.0, 1.0));
        if (i % 4 == 1) c.cosine = static_cast<float>(std::exp2(random.uniform(-60.0, -3.0)));
        if (i % 4 == 2 && c.eta < 1.0f) {
            c.cosine = static_cast<float>(std::sqrt(1.0 - double(c.eta) * double(c.eta)));
            for (int step = i % 3; step > 0; --step)
                c.cosine = std::nextafter(c.cosine, i % 5 < 2 ? 0.0f : 1.0f);
        }
        c.normal = random_float_unit(random);
        c.direction = random_float_unit(random);
        if (glm::dot(c.direction, c.normal) > 0.0f) c.direction = -c.direction;
        cases.push_back(c);
    }
    return cases;
}

// The part of unpolarised light that passes; 0 or less at and beyond the critical angle.
inline long double exact_transmittance(float cosine, float eta) {
    const long double c = cosine, n = eta;
    const long double g2 = n * n - 1.0L + c * c;
    if (g2 <= 0.0L) return n == 1.0L ? 1.0L : 0.0L;
    const long double g = std::sqrt(g2);
    const long double across = 4.0L * c * g / ((c + g) * (c + g));
    const long double within = 4.0L * n * n * c * g / ((n * n * c + g) * (n * n * c + g));
    return 0.5L * (across + within);
}

}  // namespace voxilux::test
