#include "view/picture_look.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "formats/image_file.h"

namespace voxilux {
namespace {

constexpr float kLowError = -3.0f;  // powers of ten of radiance
constexpr float kHighError = 0.0f;
constexpr float kHighCells = 5.0f;  // powers of ten of samples in an occlusion cell
constexpr float kHighSteps = 3.0f;  // powers of ten of steps

bool is_aov(DisplayChannel channel) {
    return channel != DisplayChannel::color && channel < DisplayChannel::error;
}

// Depths of the nearest and the farthest corner of the scene.
glm::dvec2 depths_of(const Camera& camera, const Box& box) {
    const glm::dvec3 forward = camera_basis(camera)[2];
    glm::dvec2 depths{std::numeric_limits<double>::max(), 0.0};
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner{(i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                                (i & 4) != 0 ? box.hi.z : box.lo.z};
        const double depth = std::max(glm::dot(corner - camera.position, forward), 0.0);
        depths = {std::min(depths.x, depth), std::max(depths.y, depth)};
    }
    return depths;
}

}  // namespace

void show_channel(DisplayChannel channel, ViewState& state) {
    state.look.channel = channel;
    fit_range(state);
    PlanRequest request = state.picture.request();
    if (!is_aov(channel) || request.effects.wants_aov) return;
    request.effects.wants_aov = true;
    try {
        state.picture.change(state.picture.settings(), request);
    } catch (const Error& error) {
        state.message = error.what();
        state.look.channel = DisplayChannel::color;
    }
}

void step_channel(int step, ViewState& state) {
    if (!state.picture.is_loaded()) return;
    const int count = static_cast<int>(kDisplayChannelNames.size());
    const int next = (static_cast<int>(state.look.channel) + step + count) % count;
    show_channel(static_cast<DisplayChannel>(next), state);
}

void expose(float stops, ViewState& state) {
    state.exposure_ev = stops;
    state.look.exposure = std::exp2(stops);
}

void fit_range(ViewState& state) {
    DisplayLook& look = state.look;
    look.low = glm::vec3(0.0f);
    look.high = glm::vec3(1.0f);
    if (look.channel == DisplayChannel::normal) look.low = glm::vec3(-1.0f);
    if (look.channel == DisplayChannel::error) {
        look.low = glm::vec3(kLowError);
        look.high = glm::vec3(kHighError);
    }
    if (look.channel == DisplayChannel::cells) look.high = glm::vec3(kHighCells);
    if (look.channel == DisplayChannel::steps) look.high = glm::vec3(kHighSteps);
    if (state.box.empty()) return;
    if (look.channel == DisplayChannel::position) {
        look.low = glm::vec3(state.box.lo);
        look.high = glm::vec3(state.box.hi);
    }
    if (look.channel == DisplayChannel::depth) {
        const glm::dvec2 depths = depths_of(state.view.camera, state.box);
        look.low = glm::vec3(static_cast<float>(depths.x));
        look.high = glm::vec3(static_cast<float>(std::max(depths.y, depths.x + 1.0)));
    }
}

void read_pixel(ViewState& state) {
    state.reading.reset();
    if (!state.picture.is_loaded() || !state.shows_panels) return;
    state.reading = state.picture.read_pixel(glm::ivec2(state.held.pointer), state.look.channel);
}

bool is_wiping(const ViewState& state) {
    return state.look.comparison != DisplayComparison::none && state.look.channel == DisplayChannel::color;
}

glm::ivec2 compare_with(const std::string& file, ViewState& state) {
    Image image = read_image(file);
    const glm::ivec2 size(image.width, image.height);
    state.picture.set_reference(std::move(image));
    state.reference_name = std::filesystem::path(file).filename().string();
    state.look.comparison = DisplayComparison::reference;
    state.message.clear();
    return size;
}

void step_comparison(ViewState& state) {
    if (state.reference_name.empty()) {
        state.message = "drop an .exr or .png to compare with";
        return;
    }
    state.look.comparison = static_cast<DisplayComparison>((static_cast<int>(state.look.comparison) + 1) % 4);
}

}  // namespace voxilux
