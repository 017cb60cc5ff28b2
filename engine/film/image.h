#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

// Planes of one size, row 0 at the top. Channel names follow OpenEXR: bare R G B A for the beauty, Z for depth,
// layer.R for the rest.
struct Image {
    enum class Precision : std::uint8_t { half, single };

    struct Channel {
        Precision precision = Precision::single;  // how it is stored in an EXR
        std::vector<float> pixels;                // [height][width]
    };

    int width = 0;
    int height = 0;
    std::map<std::string, Channel> channels;
    std::map<std::string, std::string> attributes;  // text attributes of the EXR header
};

}  // namespace voxilux
