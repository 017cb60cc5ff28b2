#include "formats/sky_image.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/printable.h"
#include "formats/exr.h"
#include "formats/hdr.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxSkyFileBytes = std::size_t{512} << 20;  // far more than its texels take
constexpr int kRowsAtOnce = 16;  // of an EXR, whose other channels take memory, too

[[noreturn]] void refuse_sky(const std::filesystem::path& path, const std::string& what) {
    throw Error(ExitCode::input_refused, fmt::format("{}: {}", printable(path.string(), kUncut), what));
}

bool is_exr(std::span<const std::byte> bytes) {
    constexpr std::array<std::uint8_t, 4> kMagic{0x76, 0x2F, 0x31, 0x01};
    return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

void append_colours(const std::filesystem::path& path, const Image& rows, SkyImage& sky) {
    const auto planes = colour_planes(rows);
    if (!planes) refuse_sky(path, "no image of a sky: it has neither R, G and B nor Y");
    for (std::size_t i = 0; i < pixel_count(rows); ++i)
        sky.texels.emplace_back((*planes)[0][i], (*planes)[1][i], (*planes)[2][i]);
}

SkyImage read_exr_sky(const std::filesystem::path& path) {
    ExrRows rows(path);
    SkyImage sky{.size = {rows.head().width, rows.head().height}};
    const std::size_t texels = pixel_count(rows.head());
    if (texels > kMaxSkyTexels)
        refuse_sky(path, fmt::format("an image of a sky may have {} texels (4096x2048), this one has {}x{}",
                                     kMaxSkyTexels, sky.size.x, sky.size.y));
    sky.texels.reserve(texels);
    for (int first = 0; first < sky.size.y; first += kRowsAtOnce)
        append_colours(path, rows.read(first, std::min(kRowsAtOnce, sky.size.y - first)), sky);
    return sky;
}

SkyImage read_hdr_sky(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const Image image = decode_hdr(bytes, path.string());
    SkyImage sky{.size = {image.width, image.height}};
    sky.texels.reserve(pixel_count(image));
    append_colours(path, image, sky);
    return sky;
}

// Whether a texel had to be repaired.
bool repair(glm::vec3& texel) {
    const glm::vec3 was = texel;
    for (int c = 0; c < 3; ++c)
        texel[c] = was[c] > 0.0f ? std::min(was[c], kMaxRadiance) : 0.0f;
    return texel != was;
}

}  // namespace

SkyImage load_sky_image(const std::filesystem::path& path, std::vector<std::string>& warnings) {
    const std::vector<std::byte> bytes = read_file(path, kMaxSkyFileBytes);
    if (!is_hdr(bytes) && !is_exr(bytes)) refuse_sky(path, "neither an EXR nor a Radiance image (.hdr)");
    SkyImage sky = is_hdr(bytes) ? read_hdr_sky(path, bytes) : read_exr_sky(path);
    const auto repaired = std::ranges::count_if(sky.texels, repair);
    if (repaired != 0)
        warnings.push_back(
            fmt::format("{}: {} of {} texels hold a value that is negative, not a number or above {:g}, "
                        "taken as 0 or that",
                        printable(path.string(), kUncut), repaired, sky.texels.size(), kMaxRadiance));
    return sky;
}

}  // namespace voxilux
