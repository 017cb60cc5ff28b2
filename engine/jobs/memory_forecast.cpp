#include "jobs/memory_forecast.h"

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "frame/footprint.h"
#include "jobs/denoise_film.h"
#include "jobs/render_options.h"
#include "plan/film_planes.h"

namespace voxilux {
namespace {

constexpr std::uint64_t kSumBytes = 8;
constexpr std::uint64_t kValueBytes = 4;
constexpr std::uint64_t kCountBytes = 8;    // sample count of a pixel, in each half
constexpr std::uint64_t kFirstValues = 4;   // position and depth
constexpr std::uint64_t kBeautyValues = 5;  // R G B, error, sample count
constexpr std::uint64_t kHalfSaving = 6;    // bytes of a pixel's beauty that an EXR does not store

// Bytes per pixel on the host.
struct PixelBytes {
    std::uint64_t film = 0;
    std::uint64_t picture = 0;
    std::uint64_t making = 0;  // in addition to both, while the image is made
};

bool is_hidden(const std::string& plane) {
    return plane.ends_with("_a") || plane.ends_with("_b");
}

PixelBytes bytes_of_pixel(const RenderPlan& plan) {
    std::uint64_t sums = 0, values = kBeautyValues;
    for (const FilmPlane& plane : film_planes(plan)) {
        sums += plane.components;
        if (!is_hidden(plane.name)) values += plane.components;
    }
    if (plan.sums_bias) values += 3;
    const std::uint64_t firsts = plan.has(Effect::aov) ? kFirstValues : 0;
    return {.film = sums * kSumBytes + firsts * kValueBytes,
            .picture = (values + firsts) * kValueBytes,
            .making = 2 * kCountBytes + (plan.sums_bias ? 3 * kSumBytes : 0)};
}

// What the denoiser takes besides its buffers: for a strip the uploads, their copy in the recording, and the
// readback; for the image the result.
std::uint64_t denoise_bytes(glm::ivec2 size) {
    const std::uint64_t pixels = static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
    constexpr std::uint64_t kOfStrip = 2 * 8 * 16 + 2 * 16;  // texels of 16 bytes
    constexpr std::uint64_t kOfPicture = 2 * 16 + 6 * kValueBytes + 2 * kSumBytes;
    const auto rows = static_cast<std::uint64_t>(most_rows(denoise_strips(size)));
    return rows * static_cast<std::uint64_t>(size.x) * kOfStrip + pixels * kOfPicture;
}

}  // namespace

PictureUse picture_use(const RenderOptions& options, double seconds) {
    return {.writes_exr = options.writes_exr,
            .writes_png = options.writes_png,
            .keeps_film = options.needs_film(),
            .writes_checkpoint = options.checkpoint_s > 0.0 && seconds > options.checkpoint_s,
            .denoises = options.plan.wants_denoised};
}

std::uint64_t end_bytes(const RenderPlan& plan, const PictureUse& use) {
    const PixelBytes bytes = bytes_of_pixel(plan);
    const std::uint64_t kept = use.keeps_film ? bytes.film : 0;
    const std::uint64_t stored = bytes.picture - kHalfSaving;
    const std::uint64_t display = plan.sums_coverage ? 4 : 3;  // values and codes of a PNG
    std::uint64_t most = bytes.film + bytes.picture + bytes.making;
    if (use.writes_exr) most = std::max(most, kept + bytes.picture + stored);
    if (use.writes_png) most = std::max(most, kept + bytes.picture + display * kValueBytes + 2 * display);
    if (use.writes_checkpoint) most = std::max(most, bytes.film + bytes.picture + stored);
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(plan.settings.size.x) * static_cast<std::uint64_t>(plan.settings.size.y);
    return most * pixels + (use.denoises && plan.is_denoised() ? denoise_bytes(plan.settings.size) : 0);
}

ResidentBytes resident_bytes() {
    ResidentBytes bytes;
    std::ifstream status("/proc/self/status");
    std::string word;
    std::uint64_t kib = 0;
    while (status >> word) {
        if (word == "VmRSS:" && status >> kib) bytes.now = kib * 1024;
        if (word == "VmHWM:" && status >> kib) bytes.peak = kib * 1024;
    }
    return bytes;
}

// What compilers of shaders have freed, the image takes again: it must not count twice.
MemoryForecast forecast_memory(const RenderPlan& plan, const PictureUse& use) {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    const ResidentBytes resident = resident_bytes();
    return {.device_bytes = footprint(plan).total_bytes(),
            .peak_rss_bytes = std::max(resident.peak, resident.now + end_bytes(plan, use))};
}

}  // namespace voxilux
