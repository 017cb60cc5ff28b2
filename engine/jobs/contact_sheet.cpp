#include "jobs/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/assert.h"
#include "formats/png.h"

namespace voxilux {
namespace {

// Copies a plane into the sheet. A plane that the image lacks is its alpha: opaque.
void paste_plane(const Image& image, const std::string& name, glm::ivec2 at, Image& sheet) {
    std::vector<float>& to = sheet.channels.at(name).pixels;
    const auto from = image.channels.find(name);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const auto pixel = static_cast<std::size_t>(y * image.width + x);
            const float value = from != image.channels.end() ? from->second.pixels[pixel] : 1.0f;
            to[static_cast<std::size_t>((at.y + y) * sheet.width + at.x + x)] = value;
        }
    }
}

}  // namespace

Image contact_sheet(std::span<const std::string> files) {
    VX_ASSERT(!files.empty());
    std::vector<Image> images;
    glm::ivec2 cell(1);
    bool has_alpha = false;
    for (const std::string& file : files) {
        images.push_back(read_png(file));
        cell = glm::max(cell, glm::ivec2(images.back().width, images.back().height));
        has_alpha |= images.back().channels.contains("A");
    }
    const int count = static_cast<int>(images.size());
    const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
    const int rows = (count + columns - 1) / columns;
    std::vector<std::string> names{"R", "G", "B"};
    if (has_alpha) names.emplace_back("A");
    Image sheet = make_image(columns * cell.x, rows * cell.y, names);
    sheet.display_referred = true;
    for (int i = 0; i < count; ++i) {
        const Image& image = images[static_cast<std::size_t>(i)];
        const glm::ivec2 free = cell - glm::ivec2(image.width, image.height);
        for (const std::string& name : names)
            paste_plane(image, name, glm::ivec2(i % columns, i / columns) * cell + free / 2, sheet);
    }
    return sheet;
}

}  // namespace voxilux
