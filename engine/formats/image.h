#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

// Pixels x0 <= x < x1, y0 <= y < y1; row 0 is the top one.
struct PixelBox {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// Planes of one size, row 0 at the top. Channel names follow OpenEXR: bare R G B A for the beauty, Z for
// depth, layer.R for the rest. Colours are linear Rec.709.
struct Image {
    enum class Precision : std::uint8_t { half, single };

    struct Channel {
        Precision precision = Precision::single;  // how it is stored in an EXR
        std::vector<float> pixels;                // [height][width]
    };

    int width = 0;
    int height = 0;
    std::optional<PixelBox> stored;  // the pixels that the file has, where it lacks some; the others are 0
    std::map<std::string, Channel> channels;
    std::map<std::string, std::vector<std::uint32_t>> words;  // planes of whole numbers, [height][width]
    std::map<std::string, std::string> attributes;            // text attributes of the EXR header
    bool display_referred =
        false;  // colours are in [0,1] and each is the decoded value of an 8-bit sRGB code
};

[[nodiscard]] inline std::size_t pixel_count(const Image& image) {
    return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

// An image with the named channels, all zero.
[[nodiscard]] inline Image make_image(int width, int height, std::span<const std::string> names) {
    Image image{.width = width, .height = height};
    for (const std::string& name : names)
        image.channels[name].pixels.resize(pixel_count(image));
    return image;
}

// The three colour planes of an image: R G B, or Y for all three. Empty when it has neither, or a plane of
// another size than the image.
[[nodiscard]] inline std::optional<std::array<std::span<const float>, 3>> colour_planes(const Image& image) {
    const bool is_grey = !image.channels.contains("R") && image.channels.contains("Y");
    const std::array<std::string, 3> names =
        is_grey ? std::array<std::string, 3>{"Y", "Y", "Y"} : std::array<std::string, 3>{"R", "G", "B"};
    std::array<std::span<const float>, 3> planes;
    for (std::size_t c = 0; c < names.size(); ++c) {
        const auto found = image.channels.find(names[c]);
        if (found == image.channels.end() || found->second.pixels.size() != pixel_count(image)) return {};
        planes[c] = found->second.pixels;
    }
    return planes;
}

// Only R, G and B, for images that are held many at once.
[[nodiscard]] inline Image colours_alone(Image image) {
    std::erase_if(image.channels, [](const auto& channel) {
        return channel.first != "R" && channel.first != "G" && channel.first != "B";
    });
    return image;
}

}  // namespace voxilux
