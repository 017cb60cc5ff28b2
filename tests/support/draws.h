#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "world/box_clusters.h"

namespace voxilux::test {

// Random numbers, places and directions, the same in every run.
class Draws {
  public:
    double operator()() { return uniform_(engine_); }
    double between(double low, double high) { return low + (high - low) * (*this)(); }
    glm::dvec3 in(const glm::dvec3& low, const glm::dvec3& high) {
        const double x = (*this)(), y = (*this)(), z = (*this)();
        return low + (high - low) * glm::dvec3(x, y, z);
    }
    glm::dvec3 direction() {
        const double z = between(-1.0, 1.0), turn = between(0.0, 2.0 * std::numbers::pi);
        const double across = std::sqrt(1.0 - z * z);
        return {across * std::cos(turn), across * std::sin(turn), z};
    }
    glm::dvec3 in(const RoundedBox& box) {
        return in(box.low, box.high) + box.radius * std::cbrt((*this)()) * direction();
    }

  private:
    std::mt19937_64 engine_{7};
    std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

}  // namespace voxilux::test
