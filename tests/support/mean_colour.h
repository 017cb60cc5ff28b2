#pragma once

#include <glm/glm.hpp>

namespace voxilux::test {

// The mean of independent colours, and its standard error.
class MeanColour {
  public:
    void add(glm::vec3 value) {
        sum_ += glm::dvec3(value);
        squares_ += glm::dvec3(value) * glm::dvec3(value);
        count_ += 1.0;
    }
    [[nodiscard]] glm::dvec3 mean() const { return sum_ / count_; }
    [[nodiscard]] glm::dvec3 error() const {
        return glm::sqrt(glm::max(squares_ / count_ - mean() * mean(), glm::dvec3(0.0)) / count_);
    }

  private:
    glm::dvec3 sum_{0.0}, squares_{0.0};
    double count_ = 0.0;
};

}  // namespace voxilux::test
