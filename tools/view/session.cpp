#include "view/session.h"

#include <chrono>
#include <memory>

#include "base/clock.h"
#include "base/error.h"
#include "base/file.h"
#include "base/print.h"
#include "interrupt.h"
#include "view/actions.h"
#include "view/file_watch.h"
#include "view/panels.h"
#include "view/picture_look.h"
#include "view/playback.h"
#include "view/render_command.h"
#include "view/screenshot.h"
#include "view/script_player.h"
#include "view/show_pace.h"
#include "view/user_interface.h"
#include "view/view_report.h"
#include "view/window.h"

namespace voxilux {
namespace {

using Clock = std::chrono::steady_clock;

constexpr glm::ivec2 kFirstSize{1280, 720};
constexpr double kIdleWait_s = 0.1;
constexpr double kMinStepShare = 0.3;  // of a frame, for samples, however long showing them takes

bool is_same_camera(const std::optional<Camera>& a, const std::optional<Camera>& b) {
    return a && b ? is_same_view(*a, *b) : a.has_value() == b.has_value();
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
        state_.ends = {command.error_target, command.time_limit_s};
        picture_.set_ends(state_.ends);
        if (!command.scene.input.empty()) load(scene_, command.scene.input);
    }

    int run() {
        const std::atomic<bool>& is_interrupted = interrupted_by_signal();
        while (!state_.wants_close && !is_interrupted)
            turn();
        if (!command_.report.empty())
            report_.write(command_.report, state_, window_.size(), device_.messages());
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
        const bool had_shadow_only = scene.ground.shadow_only;
        if (window_.size().x > 0) scene.settings.size = window_.size();
        const std::optional<Camera> own_camera = scene.camera;
        scene = window_scene(std::move(scene));
        Playback playback;
        const Scene& still = playback.load(scene, frames_to_render(command_.scene, scene).first);
        picture_.load(still, command_.scene.request);
        picture_.set_max_samples(scene.settings.spp);
        state_.input = input;
        state_.edit = {};
        state_.had_shadow_only = had_shadow_only;
        state_.box = scene_bounds(still);
        state_.view = state_.home = view_of(*still.camera, state_.box);
        shown_camera_ = *still.camera;
        own_camera_ = own_camera;
        watch_ = FileWatch(input);
        playback_ = std::move(playback);
        playback_.start(state_);
        window_.set_title("voxilux " + state_.input.filename().string());
    }

    // Somebody wrote the scene's file. The camera stays unless the file has another one, or had.
    void reload() {
        state_.has_newer_file = false;
        try {
            SceneOptions options = command_.scene;
            options.input = state_.input.string();
            const ViewPoint view = state_.view;
            const ViewPoint home = state_.home;
            const std::optional<Camera> own = own_camera_;
            load(load_scene_with(options), options.input);
            if (is_same_camera(own, own_camera_)) {
                state_.view = view;
                state_.home = home;
            }
            state_.message = "loaded again";
        } catch (const Error& error) {
            state_.message = error.what();
        }
    }

    void copy_command() {
        try {
            const std::string line = render_command(command_.words, command_.scene.input, state_);
            window_.set_clipboard(line);
            print_result("{}\n", line);
            state_.message = is_unsaved(state_.edit) ? "copied, without the unsaved edits" : "copied";
        } catch (const Error& error) {
            state_.message = error.what();
        }
    }

    // A file that cannot be shown leaves the picture as it was.
    void take_drop(const DropEvent& drop) {
        try {
            if (has_ending(drop.files.at(0), ".exr") || has_ending(drop.files.at(0), ".png"))
                return take_reference(drop.files.at(0));
            SceneOptions options = command_.scene;
            options.input = drop.files.at(0);
            load(load_scene_with(options), options.input);
            state_.message.clear();
        } catch (const Error& error) {
            state_.message = error.what();
        }
    }

    // What is dropped as an image is compared with; the window takes its size.
    void take_reference(const std::string& file) {
        const glm::ivec2 size = compare_with(file, state_);
        if (size != window_.size()) window_.resize(size);
    }

    [[nodiscard]] bool is_scripted() const { return !script_.is_empty() || command_.frames.has_value(); }

    [[nodiscard]] bool is_idle() const {
        return !is_scripted() && (!picture_.is_loaded() || picture_.is_done());
    }

    std::vector<InputEvent> take_input() {
        std::vector<InputEvent> events = window_.poll(is_idle() ? kIdleWait_s : 0.0);
        while (const ScriptAction* const action =
                   script_.next(shown_frames_, picture_, !state_.screenshots.empty())) {
            if (const auto* event = std::get_if<InputEvent>(action)) events.push_back(*event);
            if (const auto* resize = std::get_if<ResizeAction>(action)) resize_window(resize->size);
            if (const auto* shot = std::get_if<ScreenshotAction>(action))
                state_.screenshots.push_back(shot->file);
            if (const auto* edit = std::get_if<EditAction>(action)) {
                const BoxEdit box{edit->box, edit->material};
                make_edits({&box, 1}, state_);
            }
            if (const auto* save = std::get_if<SaveAction>(action)) save_edits(save->file, state_);
        }
        return events;
    }

    void resize_window(glm::ivec2 size) {
        window_.minimise(size.x == 0);
        if (size.x > 0) window_.resize(size);
    }

    void apply_changes(glm::ivec2 size) {
        if (!picture_.is_loaded()) return;
        if (size.x > 0 && size != picture_.settings().size) picture_.set_size(size);
        const Camera& camera = state_.view.camera;
        if (is_same_view(camera, shown_camera_)) return;
        try {
            picture_.set_camera(camera);
            shown_camera_ = camera;
        } catch (const Error& error) {
            state_.view = view_of(shown_camera_, state_.box);
            state_.message = error.what();
        }
    }

    void turn() {
        const double seconds = seconds_since(std::exchange(turn_began_, Clock::now()));
        const std::vector<InputEvent> events = take_input();
        const glm::ivec2 size = window_.size();
        const bool is_due = is_frame_due(events, size);
        if (is_due) take_events(events, glm::max(size, glm::ivec2(1)));
        fly(seconds, state_);
        if (std::exchange(state_.has_saved, false)) watch_.forgive();
        state_.has_newer_file |= watch_.has_changed();
        if (state_.has_newer_file && !is_unsaved(state_.edit)) reload();
        if (picture_.is_loaded()) playback_.advance(seconds, state_);
        apply_changes(size);
        if (std::exchange(state_.wants_command, false) && picture_.is_loaded()) copy_command();
        if (picture_.is_loaded()) take_samples();
        if (!is_due) return;
        aim(glm::max(size, glm::ivec2(1)), state_);
        if (size.x > 0) read_pixel(state_);
        fit_range(state_);
        draw_panels(glm::max(size, glm::ivec2(1)), state_);
        show(size);
    }

    // Whether somebody waits for a frame, or there is something new to see.
    [[nodiscard]] bool is_frame_due(const std::vector<InputEvent>& events, glm::ivec2 size) const {
        if (!events.empty() || !picture_.is_loaded() || picture_.is_moving()) return true;
        if (shown_frames_ == 0 || size != shown_size_ || !state_.screenshots.empty()) return true;
        const bool is_waiting = picture_.samples() >= script_.awaited_samples() || picture_.is_done();
        if (is_scripted() && is_waiting) return true;
        if (!pace_.is_due()) return false;
        return picture_.has_news() || is_scripted();
    }

    void take_events(const std::vector<InputEvent>& events, glm::ivec2 size) {
        interface_.begin(events, size, seconds_since(std::exchange(frame_began_, Clock::now())));
        for (const InputEvent& event : events) {
            if (const auto* drop = std::get_if<DropEvent>(&event)) take_drop(*drop);
            if (!interface_.wants(event)) take_event(event, size, state_);
        }
    }

    void take_samples() {
        const double frame_s = command_.frame_ms / 1000.0;
        picture_.set_motion_budget(std::max(frame_s - pace_.show_s(), kMinStepShare * frame_s));
        report_.add_step(picture_.advance(frame_s, script_.awaited_samples()));
    }

    void show(glm::ivec2 size) {
        const bool is_last = command_.frames && shown_frames_ + 1 >= *command_.frames;
        if (is_last && !command_.screenshot.empty()) state_.screenshots.push_back(command_.screenshot);
        const Overlay& overlay = interface_.end();
        const auto start = Clock::now();
        WindowCapture capture;
        const bool is_shown = presenter_.present(shown_picture(), overlay, size,
                                                 state_.screenshots.empty() ? nullptr : &capture);
        pace_.add(seconds_since(start));
        if (!is_shown) {
            if (size.x <= 0) (void)window_.poll(kIdleWait_s);
            return;
        }
        shown_size_ = size;
        write_screenshots(capture, state_);
        end_of_frame(seconds_since(start));
    }

    ShownPicture shown_picture() {
        if (!picture_.is_loaded()) return {};
        state_.look.divider = static_cast<std::uint32_t>(state_.divider * picture_.settings().size.x);
        state_.look.is_bgr = presenter_.is_bgr();
        const DisplayBuffer display = picture_.display(state_.look);
        if (display.size.x == 0) return {};
        return {&picture_.executor(), display.buffer, display.size};
    }

    void end_of_frame(double show_s) {
        state_.frame_s = seconds_since(std::exchange(frame_ended_, Clock::now()));
        if (shown_frames_ == 0) report_.set_first(seconds_since(start_));
        report_.add_frame(state_.frame_s, show_s);
        ++shown_frames_;
        const bool is_over = command_.frames && shown_frames_ >= *command_.frames;
        const bool has_played = !script_.is_empty() && script_.has_ended();
        if (is_over || (has_played && !command_.frames)) state_.wants_close = true;
    }

    const Clock::time_point start_ = Clock::now();
    const ViewCommand& command_;
    ScriptPlayer script_;
    Scene scene_;
    Window window_;
    Device device_;
    Presenter presenter_;
    UserInterface interface_;
    LivePicture picture_;
    ViewState state_;
    Camera shown_camera_;
    std::optional<Camera> own_camera_;  // that the file names
    FileWatch watch_;
    Playback playback_;
    ShowPace pace_;
    ViewReport report_;
    Clock::time_point turn_began_ = Clock::now();
    Clock::time_point frame_began_ = Clock::now();
    Clock::time_point frame_ended_ = Clock::now();
    std::int64_t shown_frames_ = 0;
    glm::ivec2 shown_size_{0};
};

}  // namespace

int run_session(const ViewCommand& command) {
    return Session(command).run();
}

}  // namespace voxilux
