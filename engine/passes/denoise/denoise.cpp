#include "passes/denoise/denoise.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "base/assert.h"
#include "shared/denoise.h"

namespace voxilux {
namespace {

using Pair = std::array<std::string, 2>;  // buffers of the two halves

// Rows above and below a pixel that the passes look at.
constexpr int kDenoiseApron = 48;

std::uint32_t blocks_of(glm::ivec2 size) {
    const auto along = [](int pixels) {
        return (static_cast<std::uint32_t>(pixels) + gpu::kDenoiseBlock - 1) / gpu::kDenoiseBlock;
    };
    return along(size.x) * along(size.y);
}

// Appends the passes of the denoiser over one strip.
class DenoiseRecorder {
  public:
    DenoiseRecorder(glm::ivec2 size, int most_rows, float share, Recording& recording)
        : size_(size), room_(size.x, most_rows), share_(share), recording_(recording) {}

    [[nodiscard]] std::string plane(const std::string& name) {
        return declare<glm::vec4>(recording_, "denoise." + name, pixels(room_));
    }

    [[nodiscard]] Pair planes(const std::string& name) { return {plane(name + "_a"), plane(name + "_b")}; }

    [[nodiscard]] std::string upload(const std::string& name, const std::vector<glm::vec4>& texels) {
        VX_ASSERT(texels.empty() || texels.size() == pixels(size_));
        const std::string buffer = plane(name);
        recording_.upload(buffer, std::as_bytes(std::span(texels)));
        return buffer;
    }

    // Records a pass over pixels.
    void pass(const std::string& step, std::vector<Binding> bindings, std::vector<Constant> constants = {},
              int tap_step = 1) {
        dispatch(step, {static_cast<std::uint32_t>(size_.x), static_cast<std::uint32_t>(size_.y), 1},
                 std::move(bindings), std::move(constants), tap_step);
    }

    // Sums the terms over blocks.
    [[nodiscard]] std::string sums(const std::string& terms, const Pair& normal) {
        const std::string buffer =
            declare<glm::vec4>(recording_, "denoise.sums", 2 * std::uint64_t{blocks_of(room_)});
        dispatch("block", {blocks_of(size_), 1, 1},
                 {{"Terms", terms}, {"NormalA", normal[0]}, {"NormalB", normal[1]}, {"Sums", buffer}}, {}, 1);
        return buffer;
    }

  private:
    [[nodiscard]] static std::uint64_t pixels(glm::ivec2 size) {
        return static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
    }

    void dispatch(const std::string& step, Extent extent, std::vector<Binding> bindings,
                  std::vector<Constant> constants, int tap_step) {
        const gpu::DenoisePush push{.size = size_, .step = tap_step, .share = share_};
        recording_.dispatch({.label = "denoise." + step,
                             .shader = "denoise_" + step,
                             .extent = extent,
                             .bindings = std::move(bindings),
                             .constants = std::move(constants),
                             .push = to_bytes(push)});
    }

    glm::ivec2 size_;
    glm::ivec2 room_;  // capacity of the buffers, pixels
    float share_;
    Recording& recording_;
};

void append_pair(std::vector<Binding>& bindings, const std::string& block, const Pair& buffers) {
    bindings.push_back({block + "A", buffers[0]});
    bindings.push_back({block + "B", buffers[1]});
}

std::vector<Binding> pairs(const std::vector<std::pair<std::string, Pair>>& blocks) {
    std::vector<Binding> bindings;
    for (const auto& [block, buffers] : blocks)
        append_pair(bindings, block, buffers);
    return bindings;
}

// The inputs on the device.
struct DenoiseInputs {
    Pair reflected, sharp, albedo, normal;
};

DenoiseInputs upload_inputs(const std::array<DenoiseHalf, 2>& halves, DenoiseRecorder& recorder) {
    DenoiseInputs inputs;
    for (std::size_t h = 0; h < 2; ++h) {
        const std::string half = h == 0 ? "_a" : "_b";
        inputs.reflected[h] = recorder.upload("reflected" + half, halves[h].reflected);
        inputs.sharp[h] = recorder.upload("sharp" + half, halves[h].sharp);
        inputs.albedo[h] = recorder.upload("albedo" + half, halves[h].albedo);
        inputs.normal[h] = recorder.upload("normal" + half, halves[h].normal);
    }
    return inputs;
}

// The light that surfaces receive: unfiltered first, then by level of the filter.
constexpr std::size_t kDenoiseLevels = 3;
using LightLevels = std::array<Pair, kDenoiseLevels + 1>;

LightLevels filter_levels(const DenoiseInputs& inputs, DenoiseRecorder& recorder) {
    LightLevels levels;
    for (std::size_t level = 0; level <= kDenoiseLevels; ++level)
        levels[level] = recorder.planes("light" + std::to_string(level));
    const Pair guide = recorder.planes("guide");
    for (std::size_t h = 0; h < 2; ++h) {
        recorder.pass("prepare", {{"Reflected", inputs.reflected[h]},
                                  {"Albedo", inputs.albedo[h]},
                                  {"Normal", inputs.normal[h]},
                                  {"Light", levels[0][h]},
                                  {"Guide", guide[h]}});
        for (std::size_t level = 0; level < kDenoiseLevels; ++level)
            recorder.pass(
                "filter",
                {{"Light", levels[level][h]}, {"Guide", guide[h]}, {"Filtered", levels[level + 1][h]}},
                {{"fits_slopes", level == 0 ? 0u : 1u}}, 1 << level);
    }
    return levels;
}

// Terms of the mixture of three levels, or of the undenoised image and the `fine` one.
std::string compare(const DenoiseInputs& inputs, const std::array<Pair, 3>& levels, bool is_last,
                    DenoiseRecorder& recorder) {
    const std::string terms = recorder.plane("terms");
    std::vector<Binding> bindings = pairs({{"Reflected", inputs.reflected},
                                           {"Albedo", inputs.albedo},
                                           {"Sharp", inputs.sharp},
                                           {"Fine", levels[0]},
                                           {"Middle", levels[1]},
                                           {"Coarse", levels[2]}});
    bindings.push_back({"Terms", terms});
    recorder.pass("compare", std::move(bindings), {{"is_last", is_last ? 1u : 0u}});
    return terms;
}

Pair mix_levels(const DenoiseInputs& inputs, const LightLevels& levels, DenoiseRecorder& recorder) {
    const std::string terms = compare(inputs, {levels[1], levels[2], levels[3]}, false, recorder);
    const std::string sums = recorder.sums(terms, inputs.normal);
    const Pair mixed = recorder.planes("mixed");
    std::vector<Binding> bindings = pairs({{"Normal", inputs.normal},
                                           {"Fine", levels[1]},
                                           {"Middle", levels[2]},
                                           {"Coarse", levels[3]},
                                           {"Light", levels[0]},
                                           {"Mixed", mixed}});
    bindings.push_back({"Terms", terms});
    bindings.push_back({"Sums", sums});
    recorder.pass("mix", std::move(bindings));
    return mixed;
}

Pair blend_with_plain(const DenoiseInputs& inputs, const Pair& filtered, DenoiseRecorder& recorder) {
    const std::string terms = compare(inputs, {filtered, filtered, filtered}, true, recorder);
    const std::string sums = recorder.sums(terms, inputs.normal);
    const Pair result = recorder.planes("result");
    std::vector<Binding> bindings = pairs({{"Normal", inputs.normal},
                                           {"Reflected", inputs.reflected},
                                           {"Filtered", filtered},
                                           {"Sharp", inputs.sharp},
                                           {"Result", result}});
    bindings.push_back({"Terms", terms});
    bindings.push_back({"Sums", sums});
    recorder.pass("blend", std::move(bindings));
    return result;
}

}  // namespace

std::vector<DenoiseStrip> denoise_strips(glm::ivec2 size, std::size_t strip_pixels) {
    const int block = static_cast<int>(gpu::kDenoiseBlock);
    const int rows = static_cast<int>(strip_pixels / static_cast<std::size_t>(size.x)) - 2 * kDenoiseApron;
    const int most = std::max(rows / block, 1) * block;
    std::vector<DenoiseStrip> strips;
    for (int first = 0; first < size.y; first += most) {
        const int count = std::min(most, size.y - first), low = std::max(first - kDenoiseApron, 0);
        strips.push_back({first, count, low, std::min(first + count + kDenoiseApron, size.y) - low});
    }
    return strips;
}

int most_rows(const std::vector<DenoiseStrip>& strips) {
    return std::ranges::max_element(strips, {}, &DenoiseStrip::rows)->rows;
}

DenoisedBuffers record_denoise(glm::ivec2 size, int most_rows, float share,
                               const std::array<DenoiseHalf, 2>& halves, Recording& recording) {
    VX_ASSERT(size.y <= most_rows);
    DenoiseRecorder recorder(size, most_rows, share, recording);
    const DenoiseInputs inputs = upload_inputs(halves, recorder);
    const Pair mixed = mix_levels(inputs, filter_levels(inputs, recorder), recorder);
    const Pair filtered = recorder.planes("filtered");
    for (std::size_t h = 0; h < 2; ++h)
        recorder.pass("edge", {{"Light", mixed[h]},
                               {"Albedo", inputs.albedo[h]},
                               {"Normal", inputs.normal[h]},
                               {"Reflected", filtered[h]}});
    const Pair result = blend_with_plain(inputs, filtered, recorder);
    const DenoisedBuffers denoised{.picture = recorder.plane("picture"), .errors = recorder.plane("errors")};
    std::vector<Binding> bindings =
        pairs({{"Reflected", inputs.reflected}, {"Sharp", inputs.sharp}, {"Result", result}});
    bindings.push_back({"Picture", denoised.picture});
    bindings.push_back({"Errors", denoised.errors});
    recorder.pass("error", std::move(bindings));
    recording.readback(denoised.picture);
    recording.readback(denoised.errors);
    return denoised;
}

}  // namespace voxilux
