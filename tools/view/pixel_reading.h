#pragma once

#include <cstdint>
#include <optional>

#include "film/film_sums.h"

namespace voxilux {

// Values of a film at one pixel.
struct PixelReading {
    glm::ivec2 pixel{0};
    glm::vec3 radiance{0.0f};  // the mean
    float error = 0.0f;        // standard error of its luminance
    std::uint32_t samples = 0;
    std::optional<glm::vec3> channel;  // the mean of the channel that is shown; one number three times
};

}  // namespace voxilux
