#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "formats/image.h"

namespace voxilux {

// Caps of read_exr. They bound time and memory before anything is decoded.
inline constexpr int kMaxExrSide = 1 << 17;                            // pixels, per axis of a window
inline constexpr int kMaxExrChannels = 1024;                           // channels of one part
inline constexpr std::size_t kMaxExrFileBytes = std::size_t{4} << 30;  // the file as it lies on disk
inline constexpr std::size_t kMaxExrBytes = std::size_t{16} << 30;  // all planes of the data window as floats
inline constexpr std::size_t kMaxExrFrameBytes = std::size_t{1} << 30;  // of a display window around a crop
// A deflate stream grows at most 1032 times and halves become floats: no file holds more than this per byte.
inline constexpr std::size_t kMaxExrGrowth = 2064;
inline constexpr std::size_t kFreeExrBytes = std::size_t{64} << 20;  // allowed whatever the size of the file

// Layer of the exact sums that parts of a render carry beside their image, in UINT channels.
inline constexpr const char* kSumsLayer = "sums.";

// Where the image lies in the full frame, in pixels. Full sizes of 0 mean that the image is the whole frame.
struct ExrWindow {
    int x = 0;
    int y = 0;
    int full_width = 0;
    int full_height = 0;
};

struct ExrOptions {
    ExrWindow window;           // a crop: displayWindow is the full frame, dataWindow the image
    bool reproducible = false;  // leaves the date out, so that equal pixels give equal bytes
    std::string software = "voxilux";
    std::string comments;
    std::optional<glm::vec3> background;       // linear; for callers to composite behind an image with A
    std::optional<glm::mat4> world_to_camera;  // acting on column vectors, as GLM does
    std::optional<glm::mat4> world_to_ndc;
};

// What had to change so that every stored number is finite and fits its channel.
struct WriteReport {
    std::uint64_t clamped = 0;     // finite values beyond the largest half, stored as +-65504
    std::uint64_t non_finite = 0;  // NaN, stored as 0; infinities, stored as the largest finite number
};

// Writes a scanline EXR (ZIP, 16 rows a block), each channel in its own precision, planes of whole numbers as
// UINT, row 0 on top; text attributes of the image become string attributes. Needs at least one pixel and one
// channel. The file appears whole or not at all. Throws Error(cannot_write) with the reason.
WriteReport write_exr(const std::filesystem::path& path, const Image& image, const ExrOptions& options = {});

// The first part of an EXR: all channels as floats over the display window, zero outside the data window
// (Image::stored), and string attributes. The sums of a part are left out. Throws Error(input_refused) for
// whatever cannot be read, deep and subsampled data included.
[[nodiscard]] Image read_exr(const std::filesystem::path& path);

// The first part of an EXR as it was written, some rows at a time: the data window alone, UINT channels as
// whole numbers. All functions throw as read_exr does.
class ExrRows {
  public:
    explicit ExrRows(const std::filesystem::path& path);
    ~ExrRows();
    ExrRows(const ExrRows&) = delete;
    ExrRows& operator=(const ExrRows&) = delete;

    // Size and attributes of the whole, without planes.
    [[nodiscard]] const Image& head() const;
    // `count` rows from `first` on, row 0 on top.
    [[nodiscard]] Image read(int first, int count);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// As read_exr, from bytes in memory; `name` stands for the file in messages.
[[nodiscard]] Image decode_exr(std::span<const std::byte> bytes, const std::string& name);

}  // namespace voxilux
