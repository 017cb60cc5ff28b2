#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <string>

#include "base/colour.h"
#include "formats/image.h"

namespace voxilux::test {

// A 32-bit hash (O'Neill's PCG output function, RXS-M-XS) that a few lines of any language reproduce.
inline std::uint32_t hash32(std::uint32_t n) {
    n = n * 747796405u + 2891336453u;
    const std::uint32_t word = ((n >> ((n >> 28) + 4u)) ^ n) * 277803737u;
    return (word >> 22) ^ word;
}

using PixelFunction = std::function<float(int x, int y, int channel)>;

// An image with R G B from a function of column, row and channel.
inline Image rgb_image(int width, int height, const PixelFunction& value) {
    const std::array<std::string, 3> names = {"R", "G", "B"};
    Image image = make_image(width, height, names);
    for (int c = 0; c < 3; ++c) {
        auto pixel = image.channels[names[static_cast<std::size_t>(c)]].pixels.begin();
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x)
                *pixel++ = value(x, y, c);
        }
    }
    return image;
}

inline Image constant_image(int width, int height, float value) {
    return rgb_image(width, height, [&](int, int, int) { return value; });
}

// Adds independent normal noise to every value.
inline void add_noise(Image& image, double deviation, std::mt19937& random) {
    std::normal_distribution<double> noise(0.0, deviation);
    for (auto& [name, channel] : image.channels)
        for (float& value : channel.pixels)
            value += static_cast<float>(noise(random));
}

// Display-referred image from 8-bit sRGB codes.
inline Image code_image(int width, int height, const std::function<std::uint32_t(int, int, int)>& code) {
    Image image = rgb_image(width, height, [&](int x, int y, int c) {
        return linear_from_srgb(static_cast<std::uint8_t>(code(x, y, c)));
    });
    image.display_referred = true;
    return image;
}

// White noise codes, different for every seed.
inline Image noise_image(int width, int height, std::uint32_t seed) {
    return code_image(width, height, [&](int x, int y, int c) {
        return hash32(static_cast<std::uint32_t>((y * width + x) * 3 + c) + seed) >> 24;
    });
}

}  // namespace voxilux::test
