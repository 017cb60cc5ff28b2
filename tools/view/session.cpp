#include "view/session.h"

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/clock.h"
#include "base/colour.h"
#include "base/error.h"
#include "base/file.h"
#include "film/film_sums.h"
#include "formats/image_file.h"
#include "interrupt.h"
#include "view/actions.h"
#include "view/panels.h"
#include "view/user_interface.h"
#include "view/window.h"
#include "write_json.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr glm::ivec2 kFirstSize{1280, 720};
constexpr double kIdleWait_s = 0.1;

Image image_of(const WindowCapture& capture) {
    const std::array<std::string, 3> names{"R", "G", "B"};
    Image image = make_image(capture.size.x, capture.size.y, names);
    image.display_referred = true;
    const std::array<float, 256> decoded = decoded_srgb_codes();
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float>& plane = image.channels[names[c]].pixels;
        for (std::size_t i = 0; i < plane.size(); ++i)
            plane[i] = decoded[capture.rgb[3 * i + c]];
    }
    return image;
}

// One run of the window: events in, frames out.
class Session {
  public:
    explicit Session(const ViewCommand& command)
        : command_(command),
          script_(command.script.empty() ? ViewScript{} : read_script(command.script)),
          scene_(scene_of(command)),
          window_("voxilux", scene_.settings.size),
          device_(open_device(device_request())),
          presenter_(device_, window_.surface(), window_shaders()),
          interface_(presenter_, window_.scale()),
          picture_(device_, {.cache_dir = command.device.cache_dir()}),
          state_(picture_) {
        picture_.set_frame_time(command.frame_ms / 1000.0);
        if (!command.scene.input.empty()) load(scene_, command.scene.input);
    }

    int run() {
        const std::atomic<bool>& is_interrupted = interrupted_by_signal();
        auto last = Clock::now();
        while (!state_.wants_close && !is_interrupted) {
            const double seconds = seconds_since(std::exchange(last, Clock::now()));
            if (shown_frames_ > 0) state_.frame_s = seconds;
            if (show_frame(seconds)) end_of_frame(seconds);
        }
        write_report();
        return static_cast<int>(ExitCode::done);
    }

  private:
    static Scene scene_of(const ViewCommand& command) {
        if (!command.scene.input.empty()) return load_scene_with(command.scene);
        Scene scene;
        scene.settings.size = kFirstSize;
        return scene;
    }

    [[nodiscard]] DeviceRequest device_request() const {
        DeviceRequest request = command_.device.request();
        request.surface = &window_.surface();
        return request;
    }

    void load(Scene scene, const std::string& input) {
        scene.settings.size = window_.size().x > 0 ? window_.size() : scene.settings.size;
        scene.background = {};  // a window shows the sky, and so the ground
        scene.ground.shadow_only = false;
        scene.camera = camera_of(scene);
        // Images in motion are smaller, and the size of an orthographic one says what it shows.
        if (scene.camera->projection == Projection::orthographic) {
            scene.camera->projection = Projection::perspective;
            scene.camera = framing_camera(scene, *scene.camera);
        }
        picture_.load(scene, command_.scene.request);
        picture_.set_max_samples(scene.settings.spp);
        state_.input = input;
        state_.box = scene_bounds(scene);
        state_.view = state_.home = view_of(*scene.camera, state_.box);
        shown_camera_ = *scene.camera;
        window_.set_title("voxilux " + state_.input.filename().string());
    }

    // A file that cannot be shown leaves the picture as it was.
    void take_drop(const DropEvent& drop) {
        try {
            SceneOptions options = command_.scene;
            options.input = drop.files.at(0);
            load(load_scene_with(options), options.input);
            state_.message.clear();
        } catch (const Error& error) {
            state_.message = error.what();
        }
    }

    [[nodiscard]] bool is_idle() const {
        return script_.steps.empty() && !command_.frames && (!picture_.is_loaded() || picture_.is_done());
    }

    std::vector<InputEvent> take_input() {
        std::vector<InputEvent> events = window_.poll(is_idle() ? kIdleWait_s : 0.0);
        while (next_step_ < script_.steps.size() && is_due(script_.steps[next_step_])) {
            const ScriptAction& action = script_.steps[next_step_].action;
            // A screenshot is of this frame: what comes after it waits.
            if (!state_.screenshots.empty() && !std::holds_alternative<ScreenshotAction>(action)) break;
            ++next_step_;
            if (const auto* event = std::get_if<InputEvent>(&action)) events.push_back(*event);
            if (const auto* resize = std::get_if<ResizeAction>(&action)) resize_window(resize->size);
            if (const auto* shot = std::get_if<ScreenshotAction>(&action))
                state_.screenshots.push_back(shot->file);
            if (const auto* edit = std::get_if<EditAction>(&action)) edit_boxes(*edit);
        }
        return events;
    }

    // The film that the script waits for is not to grow beyond.
    [[nodiscard]] std::uint32_t awaited_samples() const {
        return next_step_ < script_.steps.size() ? script_.steps[next_step_].samples.value_or(kNoEnd)
                                                 : kNoEnd;
    }

    [[nodiscard]] bool is_due(const ScriptStep& step) {
        if (step.frame > shown_frames_) return false;
        return !step.samples ||
               (picture_.is_loaded() && !picture_.is_moving() && picture_.samples() >= *step.samples);
    }

    void resize_window(glm::ivec2 size) {
        window_.minimise(size.x == 0);
        if (size.x > 0) window_.resize(size);
    }

    void edit_boxes(const EditAction& edit) {
        const BoxEdit box{edit.box, edit.material};
        try {
            picture_.edit({&box, 1});
        } catch (const Error& error) {
            state_.message = error.what();
        }
    }

    void apply_changes(glm::ivec2 size) {
        if (!picture_.is_loaded()) return;
        if (size.x > 0 && size != picture_.settings().size) picture_.set_size(size);
        const Camera& camera = state_.view.camera;
        if (camera.position == shown_camera_.position && camera.yaw_deg == shown_camera_.yaw_deg &&
            camera.pitch_deg == shown_camera_.pitch_deg)
            return;
        picture_.set_camera(camera);
        shown_camera_ = camera;
    }

    // True when a frame reached the window.
    bool show_frame(double seconds) {
        const std::vector<InputEvent> events = take_input();
        const glm::ivec2 size = window_.size();
        interface_.begin(events, glm::max(size, glm::ivec2(1)), seconds);
        for (const InputEvent& event : events) {
            if (const auto* drop = std::get_if<DropEvent>(&event)) take_drop(*drop);
            if (!is_of_panels(event)) take_event(event, glm::max(size, glm::ivec2(1)), state_);
        }
        fly(seconds, state_);
        apply_changes(size);
        if (picture_.is_loaded()) frame_ = picture_.advance(command_.frame_ms / 1000.0, awaited_samples());
        draw_panels(state_);
        return present(interface_.end(), size);
    }

    // Releases always reach the view, so that nothing stays held.
    [[nodiscard]] bool is_of_panels(const InputEvent& event) const {
        if (const auto* button = std::get_if<ButtonEvent>(&event))
            return button->is_down && interface_.wants_mouse();
        if (std::holds_alternative<ScrollEvent>(event)) return interface_.wants_mouse();
        const auto* key = std::get_if<KeyEvent>(&event);
        return key != nullptr && key->is_down && interface_.wants_keys();
    }

    bool present(const Overlay& overlay, glm::ivec2 size) {
        ShownPicture shown;
        if (picture_.is_loaded()) {
            const DisplayBuffer display = picture_.display();
            shown.buffer = display.buffer;
            if (display.size.x > 0) shown.executor = &picture_.executor();
            shown.how.size = display.size;
        }
        shown.how.exposure = std::exp2(state_.exposure_ev);
        shown.how.is_filmic = state_.curve == ToneMap::filmic ? 1u : 0u;
        const bool is_last = command_.frames && shown_frames_ + 1 >= *command_.frames;
        if (is_last && !command_.screenshot.empty()) state_.screenshots.push_back(command_.screenshot);
        WindowCapture capture;
        const bool is_shown =
            presenter_.present(shown, overlay, size, state_.screenshots.empty() ? nullptr : &capture);
        if (is_shown)
            write_screenshots(capture);
        else if (size.x <= 0)
            (void)window_.poll(kIdleWait_s);
        return is_shown;
    }

    void write_screenshots(const WindowCapture& capture) {
        for (const std::string& file : std::exchange(state_.screenshots, {})) {
            if (has_ending(file, ".exr")) {
                if (picture_.is_loaded()) write_image(file, picture_of(picture_.renderer().read_film()));
            } else {
                write_image(file, image_of(capture));
            }
        }
    }

    void end_of_frame(double seconds) {
        ++shown_frames_;
        if (!command_.report.empty())
            frames_.push_back({{"ms", 1000.0 * seconds},
                               {"step_ms", 1000.0 * frame_.step_s},
                               {"samples", frame_.samples},
                               {"width", frame_.size.x},
                               {"height", frame_.size.y}});
        const bool is_over = command_.frames && shown_frames_ >= *command_.frames;
        const bool has_played = !script_.steps.empty() && next_step_ == script_.steps.size();
        if (is_over || (has_played && !command_.frames)) state_.wants_close = true;
    }

    void write_report() {
        if (command_.report.empty()) return;
        const Camera& camera = state_.view.camera;
        const glm::ivec2 size = window_.size();
        write_json(command_.report,
                   {{"frames", frames_},
                    {"shown",
                     {{"input", state_.input.string()},
                      {"window", {size.x, size.y}},
                      {"camera",
                       {{"position", {camera.position.x, camera.position.y, camera.position.z}},
                        {"yaw", camera.yaw_deg},
                        {"pitch", camera.pitch_deg},
                        {"fov_y", camera.fov_y_deg}}}}},
                    {"messages", device_.messages()}});
    }

    const ViewCommand& command_;
    ViewScript script_;
    Scene scene_;
    Window window_;
    Device device_;
    Presenter presenter_;
    UserInterface interface_;
    LivePicture picture_;
    ViewState state_;
    Camera shown_camera_;
    LiveFrame frame_;
    Json frames_ = Json::array();
    std::int64_t shown_frames_ = 0;
    std::size_t next_step_ = 0;
};

}  // namespace

int run_session(const ViewCommand& command) {
    return Session(command).run();
}

}  // namespace voxilux
