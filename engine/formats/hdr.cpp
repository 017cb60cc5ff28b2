#include "formats/hdr.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/read_or_refuse.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxHdrLine = 4096;              // bytes
constexpr std::size_t kMaxHdrLines = 1024;             // of a header
constexpr int kMinRunWidth = 8, kMaxRunWidth = 32767;  // of rows that may hold runs, pixels
constexpr int kExponentBias = 136;                     // 128, and 8 bits of mantissa
constexpr std::size_t kComponents = 4;                 // R, G, B and their exponent

// Reads past the end throw.
class HdrBytes {
  public:
    explicit HdrBytes(std::span<const std::byte> bytes) : bytes_(bytes) {}

    std::uint8_t next() {
        if (at_ == bytes_.size()) throw std::runtime_error("the file ends early");
        return static_cast<std::uint8_t>(bytes_[at_++]);
    }
    std::string line() {
        std::string text;
        for (auto c = static_cast<char>(next()); c != '\n'; c = static_cast<char>(next())) {
            if (text.size() == kMaxHdrLine) throw std::runtime_error("a line of its header does not end");
            text += c;
        }
        return text;
    }

  private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
};

void read_header(HdrBytes& in) {
    (void)in.line();  // the magic word
    for (std::size_t lines = 0; lines < kMaxHdrLines; ++lines) {
        const std::string line = in.line();
        if (line.empty()) return;
        if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
            throw std::runtime_error("its format is not 32-bit_rle_rgbe");
    }
    throw std::runtime_error(fmt::format("its header has over {} lines", kMaxHdrLines));
}

// The number that the text begins with, which is cut off.
int take_number(std::string_view& text) {
    int number = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
    text.remove_prefix(static_cast<std::size_t>(parsed.ptr - text.data()));
    return parsed.ec == std::errc() ? number : 0;
}

glm::ivec2 read_size(HdrBytes& in) {
    const std::string line = in.line();
    constexpr std::string_view kDown = "-Y ", kRight = " +X ";
    std::string_view rest = line;
    glm::ivec2 size(0);
    if (rest.starts_with(kDown)) {
        rest.remove_prefix(kDown.size());
        size.y = take_number(rest);
        if (rest.starts_with(kRight)) {
            rest.remove_prefix(kRight.size());
            size.x = take_number(rest);
        }
    }
    if (size.x < 1 || size.y < 1 || !rest.empty())
        throw std::runtime_error("its size is not of the form '-Y HEIGHT +X WIDTH'");
    if (static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) > kMaxHdrPixels)
        throw std::runtime_error(
            fmt::format("{}x{} pixels, over the limit of {} in all", size.x, size.y, kMaxHdrPixels));
    return size;
}

// A component of a row of pixels, as runs of equal values (a count above 128) and of others.
void read_runs(HdrBytes& in, std::size_t width, std::size_t component, std::vector<std::uint8_t>& row) {
    for (std::size_t x = 0; x < width;) {
        const std::uint8_t count = in.next();
        const bool is_equal = count > 128;
        const std::size_t length = is_equal ? count - 128u : count;
        if (length == 0 || length > width - x) throw std::runtime_error("a run leaves its row");
        std::uint8_t value = is_equal ? in.next() : std::uint8_t{0};
        for (std::size_t k = 0; k < length; ++k, ++x) {
            if (!is_equal) value = in.next();
            row[kComponents * x + component] = value;
        }
    }
}

void read_row(HdrBytes& in, std::vector<std::uint8_t>& row) {
    const std::size_t width = row.size() / kComponents;
    for (std::size_t k = 0; k < kComponents; ++k)
        row[k] = in.next();
    const bool may_run = width >= kMinRunWidth && width <= kMaxRunWidth;
    if (may_run && row[0] == 2 && row[1] == 2 && row[2] < 128) {
        if (static_cast<std::size_t>(row[2] << 8 | row[3]) != width)
            throw std::runtime_error("a row has another width than the image");
        for (std::size_t component = 0; component < kComponents; ++component)
            read_runs(in, width, component, row);
        return;
    }
    for (std::size_t k = kComponents; k < row.size(); ++k)
        row[k] = in.next();
}

}  // namespace

bool is_hdr(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.starts_with("#?RADIANCE\n") || text.starts_with("#?RGBE\n");
}

Image decode_hdr(std::span<const std::byte> bytes, const std::string& name) {
    return read_or_refuse(name, "a readable Radiance image", [&] {
        if (!is_hdr(bytes)) throw std::runtime_error("it does not begin as one does");
        HdrBytes in(bytes);
        read_header(in);
        const glm::ivec2 size = read_size(in);
        const std::array<std::string, 3> names{"R", "G", "B"};
        Image image = make_image(size.x, size.y, names);
        std::vector<std::uint8_t> row(kComponents * static_cast<std::size_t>(size.x));
        std::size_t pixel = 0;
        for (int y = 0; y < size.y; ++y) {
            read_row(in, row);
            for (std::size_t x = 0; x < static_cast<std::size_t>(size.x); ++x, ++pixel) {
                const std::uint8_t* rgbe = &row[kComponents * x];
                const float scale = rgbe[3] == 0 ? 0.0f : std::ldexp(1.0f, rgbe[3] - kExponentBias);
                for (std::size_t c = 0; c < names.size(); ++c)
                    image.channels[names[c]].pixels[pixel] = scale * static_cast<float>(rgbe[c]);
            }
        }
        return image;
    });
}

}  // namespace voxilux
