#include "formats/png.h"

#include <fmt/format.h>
#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>

#include "base/assert.h"
#include "base/colour.h"
#include "base/error.h"
#include "base/file.h"

namespace voxilux {
namespace {

constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

std::vector<std::uint8_t> encode_pixels(const Image& image, const std::vector<float>* alpha) {
    const auto planes = colour_planes(image);
    VX_ASSERT(planes.has_value());
    const std::size_t count = pixel_count(image);
    std::vector<std::uint8_t> codes;
    codes.reserve(count * (alpha != nullptr ? 4 : 3));
    for (std::size_t i = 0; i < count; ++i) {
        for (const auto& plane : *planes)
            codes.push_back(srgb_code(plane[i]));
        if (alpha == nullptr) continue;
        const float a = (*alpha)[i] > 0.0f ? std::min((*alpha)[i], 1.0f) : 0.0f;
        codes.push_back(static_cast<std::uint8_t>(a * 255.0f + 0.5f));
    }
    return codes;
}

void append(void* context, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::byte>*>(context);
    const auto* first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
}

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
    throw Error(ExitCode::input_refused, fmt::format("{}: not a readable PNG: {}", name, reason));
}

// Width, height and number of channels, checked against the caps before anything is decoded.
struct PngSize {
    int width = 0, height = 0, channels = 0;
};

PngSize check_png(std::span<const stbi_uc> bytes, const std::string& name) {
    if (bytes.size() < kSignature.size() || !std::equal(kSignature.begin(), kSignature.end(), bytes.begin()))
        refuse(name, "it does not begin as a PNG does");
    if (bytes.size() > kMaxPngFileBytes) refuse(name, fmt::format("over {} bytes", kMaxPngFileBytes));
    PngSize size;
    if (stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &size.width, &size.height,
                              &size.channels) == 0)
        refuse(name, stbi_failure_reason());
    const bool fits =
        size.width >= 1 && size.height >= 1 && size.width <= kMaxPngSide && size.height <= kMaxPngSide;
    const std::size_t decoded =
        4 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    if (!fits || decoded > kMaxPngBytes)
        refuse(name, fmt::format("{}x{} pixels, over the limit of {} a side and {} bytes in all", size.width,
                                 size.height, kMaxPngSide, kMaxPngBytes));
    return size;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image) {
    VX_ASSERT(image.width > 0 && image.height > 0);
    if (pixel_count(image) > kMaxPngBytes / 4) {
        throw Error(ExitCode::cannot_write,
                    fmt::format("{}: cannot write: {}x{} pixels are too many for a PNG, write an EXR",
                                path.string(), image.width, image.height));
    }
    const auto alpha = image.channels.find("A");
    const bool has_alpha = alpha != image.channels.end();
    const int channels = has_alpha ? 4 : 3;
    const std::vector<std::uint8_t> codes = encode_pixels(image, has_alpha ? &alpha->second.pixels : nullptr);
    std::vector<std::byte> bytes;
    if (stbi_write_png_to_func(append, &bytes, image.width, image.height, channels, codes.data(),
                               image.width * channels) == 0)
        throw Error(ExitCode::cannot_write, fmt::format("{}: cannot write: out of memory", path.string()));
    write_file_atomically(path, bytes);
}

Image decode_png(std::span<const std::byte> bytes, const std::string& name) {
    const std::span<const stbi_uc> data(reinterpret_cast<const stbi_uc*>(bytes.data()), bytes.size());
    const bool has_alpha = check_png(data, name).channels % 2 == 0;
    const int wanted = has_alpha ? 4 : 3;
    int width = 0, height = 0, stored = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> codes(
        stbi_load_from_memory(data.data(), static_cast<int>(data.size()), &width, &height, &stored, wanted),
        &stbi_image_free);
    if (!codes) refuse(name, stbi_failure_reason());
    const std::array<float, 256> decoded = decoded_srgb_codes();
    Image image{.width = width, .height = height, .display_referred = true};
    const std::array<const char*, 4> names = {"R", "G", "B", "A"};
    for (int c = 0; c < wanted; ++c) {
        Image::Channel& channel = image.channels[names[static_cast<std::size_t>(c)]];
        channel.pixels.resize(pixel_count(image));
        for (std::size_t i = 0; i < channel.pixels.size(); ++i) {
            const stbi_uc code =
                codes.get()[i * static_cast<std::size_t>(wanted) + static_cast<std::size_t>(c)];
            channel.pixels[i] = c == 3 ? static_cast<float>(code) / 255.0f : decoded[code];
        }
    }
    return image;
}

Image read_png(const std::filesystem::path& path) {
    return decode_png(read_file(path, kMaxPngFileBytes), path.string());
}

}  // namespace voxilux
