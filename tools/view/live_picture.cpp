#include "view/live_picture.h"

#include <algorithm>

#include "base/clock.h"
#include "base/error.h"
#include "plan/error_law.h"

namespace voxilux {
namespace {

// Frames without a change after which the picture counts as at rest.
constexpr int kRestFrames = 5;
// Frames of a motion that the plan is told of: enough to make shared occlusion worth while.
constexpr std::uint32_t kMotionFrames = 1000;

// The channels of an image file that correspond to a display channel.
std::array<std::string, 3> channel_names(DisplayChannel channel) {
    switch (channel) {
        case DisplayChannel::albedo:
            return {"albedo.R", "albedo.G", "albedo.B"};
        case DisplayChannel::normal:
            return {"N.X", "N.Y", "N.Z"};
        case DisplayChannel::position:
            return {"P.X", "P.Y", "P.Z"};
        case DisplayChannel::depth:
            return {"Z", "Z", "Z"};
        case DisplayChannel::ao:
            return {"ao.Y", "ao.Y", "ao.Y"};
        case DisplayChannel::sun:
            return {"sun.Y", "sun.Y", "sun.Y"};
        default:
            return {};
    }
}

RenderSettings moving(RenderSettings settings, const Resolution& resolution) {
    settings.size = resolution.size_in(settings.size);
    return settings;
}

// The camera that shows in an image of size `size` what it shows in one of size `rest`.
Camera resized(Camera camera, glm::ivec2 rest, glm::ivec2 size) {
    camera.pixels_per_voxel *= static_cast<double>(size.y) / rest.y;
    return camera;
}

// Occlusion stands in for indirect light, and frames can share it.
PlanRequest moving(PlanRequest request) {
    request.frames = kMotionFrames;
    request.effects.switches[Effect::indirect] = Switch::off;
    request.effects.switches[Effect::caustics] = Switch::off;
    return request;
}

}  // namespace

void LivePicture::load(const Scene& scene, const PlanRequest& request) {
    Scene coarse = scene;
    coarse.settings = moving(scene.settings, resolution_);
    coarse.camera = resized(*scene.camera, scene.settings.size, coarse.settings.size);
    if (measure_scene(scene).has_voxels)
        renderer_.prepare_editable(coarse, moving(request));
    else
        renderer_.prepare(coarse, moving(request));
    settings_ = scene.settings;
    camera_ = *scene.camera;
    request_ = request;
    rest_plan_.reset();
    resolution_.start();
    moving_frames_ = kRestFrames;
}

void LivePicture::set_camera(const Camera& camera) {
    begin_motion();
    renderer_.set_camera(resized(camera, settings_.size, renderer_.plan().image_size));
    camera_ = camera;
}

void LivePicture::set_sun(const Sun& sun) {
    begin_motion();
    renderer_.set_sun(sun);
}

// An orthographic camera depends on the size of the image, so it follows the size of the plan.
void LivePicture::fit_camera() {
    if (camera_.projection == Projection::orthographic)
        renderer_.set_camera(resized(camera_, settings_.size, renderer_.plan().image_size));
}

void LivePicture::set_frame(const Scene& still) {
    begin_motion();
    Scene coarse = still;
    coarse.settings = moving(settings_, resolution_);
    coarse.camera = resized(camera_, settings_.size, coarse.settings.size);
    renderer_.set_voxels(coarse);
}

void LivePicture::set_size(glm::ivec2 size) {
    settings_.size = size;
    apply_motion();
}

void LivePicture::change(const RenderSettings& settings, const PlanRequest& request) {
    renderer_.change(settings, request);  // throws where the picture at rest cannot be rendered
    rest_plan_ = renderer_.plan();
    settings_ = settings;
    request_ = request;
    apply_motion();
}

std::vector<BoxEdit> LivePicture::edit(std::span<const BoxEdit> edits) {
    begin_motion();
    return renderer_.edit(edits);
}

void LivePicture::set_reference(Image image) {
    const auto planes = colour_planes(image);
    if (!planes) throw Error(ExitCode::input_refused, "it has no colours");
    reference_.resize(3 * pixel_count(image));
    for (std::size_t i = 0; i < reference_.size(); ++i)
        reference_[i] = (*planes)[i % 3][i / 3];
    reference_size_ = {image.width, image.height};
    reference_image_ = std::move(image);
    flip_.clear();
    sent_ = DisplayComparison::none;
    has_news_ = true;
}

bool LivePicture::is_reference_of(glm::ivec2 size) const {
    return !reference_.empty() && reference_size_ == size;
}

// Computes FLIP of the picture at rest while somebody looks at it.
void LivePicture::compute_flip() {
    if (flip_.collect(waits_)) {
        sent_ = DisplayComparison::none;
        has_news_ = true;
    }
    const bool is_wanted =
        shown_look_.comparison == DisplayComparison::map && is_reference_of(settings_.size) && samples() > 0;
    if (!is_wanted || !flip_.is_due(samples(), is_done())) return;
    flip_.start(reference_image_, picture_of(renderer_.read_film()), samples());
    if (waits_) compute_flip();
}

void LivePicture::send_reference(DisplayComparison comparison) {
    const DisplayComparison wanted =
        comparison == DisplayComparison::map ? comparison : DisplayComparison::reference;
    if (std::exchange(sent_, wanted) == wanted) return;
    if (wanted == DisplayComparison::reference) return renderer_.set_reference(reference_);
    std::vector<float> numbers;
    for (const float error : flip_.result()->error)
        numbers.insert(numbers.end(), 3, error);
    renderer_.set_reference(numbers);
}

std::optional<PixelReading> LivePicture::read_pixel(glm::ivec2 pixel, DisplayChannel channel) {
    if (is_moving() || samples() == 0) return std::nullopt;
    pixel = glm::clamp(pixel, glm::ivec2(0), renderer_.plan().settings.size - 1);
    const FilmSums row = renderer_.ready_film().read_rows({static_cast<std::uint32_t>(pixel.y), 1});
    const Image image = picture_of(row);
    const auto at = [&](const std::string& name) {
        return image.channels.at(name).pixels[static_cast<std::size_t>(pixel.x)];
    };
    PixelReading reading{.pixel = pixel,
                         .radiance = {at("R"), at("G"), at("B")},
                         .error = at("error.Y"),
                         .samples = row.even[0] + row.odd[0]};
    const std::array<std::string, 3> names = channel_names(channel);
    if (!names[0].empty() && image.channels.contains(names[0]))
        reading.channel = glm::vec3(at(names[0]), at(names[1]), at(names[2]));
    return reading;
}

void LivePicture::begin_motion() {
    if (!is_moving()) apply_motion();
    moving_frames_ = kRestFrames;
}

void LivePicture::apply_motion() {
    flip_.clear();
    replan_motion();
    moving_frames_ = kRestFrames;
}

// Plans the same scene coarser, and with techniques that share samples between frames.
void LivePicture::replan_motion() {
    renderer_.change(moving(settings_, resolution_), moving(request_));
    fit_camera();
    resolution_.start();
}

void LivePicture::end_motion() {
    renderer_.change(settings_, request_);
    fit_camera();
    rest_plan_ = renderer_.plan();
    statistics_ = {};
    errors_.start(error_law(*rest_plan_));
}

void LivePicture::set_ends(const SampleEnds& ends) {
    ends_ = ends;
    errors_.set_target(ends.error);
}

bool LivePicture::is_done() const {
    const bool is_late = ends_.time_limit_s && errors_.seconds() >= *ends_.time_limit_s;
    return !is_moving() && (samples() >= max_samples() || errors_.has_reached_target() || is_late);
}

LiveFrame LivePicture::advance(double budget_s, std::uint32_t end_samples) {
    if (is_moving() && --moving_frames_ == 0) end_motion();
    if (is_moving()) return advance_motion(budget_s);
    const auto start = std::chrono::steady_clock::now();
    const std::uint32_t end = std::min(end_samples, max_samples());
    while (renderer_.regrow_boxes() && seconds_since(start) < budget_s) {
    }
    if (samples() < end && !is_done()) take_samples(budget_s, end);
    compute_flip();
    return {renderer_.plan().settings.size, samples(), seconds_since(start)};
}

void LivePicture::take_samples(double budget_s, std::uint32_t end_samples) {
    const auto start = std::chrono::steady_clock::now();
    // Steps end at whole samples where the error is looked at.
    const std::uint32_t look = std::max(errors_.next_look(), samples() + 1);
    const StepResult step = renderer_.step(budget_s, std::min(end_samples, look));
    errors_.add_time(seconds_since(start));
    add_step(step, *rest_plan_, statistics_);
    if (step.samples == 0) return;
    has_news_ = true;
    if (errors_.is_due(samples()))
        errors_.add(samples(), claimed_error_of(renderer_.ready_film().read_for_error(), statistics_.faults));
}

// One whole sample, however long it takes.
LiveFrame LivePicture::advance_motion(double budget_s) {
    // Not in the frame that the new size was learnt from: that one is shown first.
    if (std::exchange(has_other_size_, false)) replan_motion();
    const auto start = std::chrono::steady_clock::now();
    const std::uint32_t before = samples();
    LiveFrame frame{.size = renderer_.plan().settings.size};
    while (samples() == before)
        add_step_times(frame.built, renderer_.step(budget_s, before + 1).built);
    has_news_ = true;
    frame.samples = samples();
    frame.step_s = seconds_since(start);
    has_other_size_ = resolution_.learn(frame.step_s);
    return frame;
}

DisplayBuffer LivePicture::display(const DisplayLook& look) {
    const bool is_new = std::exchange(has_news_, false) || look != shown_look_;
    // An empty film cannot show the new look. A coarse one soon can.
    if (samples() == 0 && look != shown_look_) begin_motion();
    if (samples() > 0 && is_new) {
        shown_look_ = look;
        DisplayLook shown = look;
        if (!has_channel(renderer_.plan(), look.channel)) shown.channel = DisplayChannel::color;
        const bool has_map = shown.comparison != DisplayComparison::map || flip_.result();
        if (!is_reference_of(renderer_.plan().settings.size) || !has_map)
            shown.comparison = DisplayComparison::none;
        if (shown.comparison != DisplayComparison::none) send_reference(shown.comparison);
        shown_ = renderer_.display(shown);
    }
    return shown_;
}

}  // namespace voxilux
