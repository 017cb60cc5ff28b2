#include "view/session.h"

#include <chrono>
#include <memory>

#include "base/clock.h"
#include "base/error.h"
#include "base/print.h"
#include "interrupt.h"
#include "view/actions.h"
#include "view/panels.h"
#include "view/picture_look.h"
#include "view/render_command.h"
#include "view/scene_files.h"
#include "view/screenshot.h"
#include "view/script_player.h"
#include "view/show_pace.h"
#include "view/user_interface.h"
#include "view/view_report.h"
#include "view/window.h"

namespace voxilux {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kIdleWait_s = 0.1;
constexpr double kMinStepShare = 0.3;  // share of a frame left for samples, however long showing takes

// One run of the window: events in, frames out.
class Session {
  public:
    explicit Session(const ViewCommand& command)
        : command_(command),
          script_(command.script.empty() ? ViewScript{} : read_script(command.script)),
          memory_file_(memory_file_of(command)),
          memory_(read_memory(memory_file_)),
          watch_(command.scene.input),
          scene_(first_scene(command, memory_)),
          window_("voxilux", scene_.settings.size),
          device_(open_device(device_request())),
          presenter_(device_, window_.surface(), window_shaders()),
          interface_(presenter_, window_.scale()),
          picture_(device_, {.cache_dir = command.device.cache_dir()}),
          state_(picture_),
          files_(command, memory_file_, window_, state_) {
        state_.ends = {command.error_target, command.time_limit_s};
        picture_.set_ends(state_.ends);
        picture_.set_waits(is_scripted());
        state_.memory = std::move(memory_);
        state_.memory.frame_ms = command.frame_ms.value_or(state_.memory.frame_ms);
        if (!command.scene.input.empty()) files_.show(std::move(scene_), command.scene.input, watch_);
    }

    int run() {
        const std::atomic<bool>& is_interrupted = interrupted_by_signal();
        while (!state_.wants_close && !is_interrupted)
            turn();
        if (!command_.report.empty())
            report_.write(command_.report, state_, window_.size(), device_.messages());
        files_.remember();
        return static_cast<int>(ExitCode::done);
    }

  private:
    [[nodiscard]] DeviceRequest device_request() const {
        DeviceRequest request = command_.device.request();
        request.surface = &window_.surface();
        return request;
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

    [[nodiscard]] bool is_scripted() const { return !script_.is_empty() || command_.frames.has_value(); }

    [[nodiscard]] bool is_idle() const {
        return !is_scripted() && !files_.is_busy() && (!picture_.is_loaded() || picture_.is_done());
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
        if (is_same_view(camera, picture_.camera())) return;
        try {
            picture_.set_camera(camera);
        } catch (const Error& error) {
            state_.view = view_of(picture_.camera(), state_.box);
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
        files_.follow();
        files_.play(seconds);
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

    // Whether somebody waits for a frame, or there is something new to show.
    [[nodiscard]] bool is_frame_due(const std::vector<InputEvent>& events, glm::ivec2 size) const {
        if (!events.empty() || files_.is_busy() || !picture_.is_loaded() || picture_.is_moving()) return true;
        if (shown_frames_ == 0 || size != shown_size_ || !state_.screenshots.empty()) return true;
        const bool is_waiting = picture_.samples() >= script_.awaited_samples() || picture_.is_done();
        if (is_scripted() && is_waiting) return true;
        if (!pace_.is_due()) return false;
        return picture_.has_news() || is_scripted();
    }

    void take_events(const std::vector<InputEvent>& events, glm::ivec2 size) {
        interface_.begin(events, size, seconds_since(std::exchange(frame_began_, Clock::now())));
        for (const InputEvent& event : events) {
            if (const auto* drop = std::get_if<DropEvent>(&event)) files_.open(drop->files.at(0));
            if (!interface_.wants(event)) take_event(event, size, state_);
        }
    }

    void take_samples() {
        const double frame_s = state_.memory.frame_ms / 1000.0;
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
        if (!command_.report.empty()) report_.add_frame(state_.frame_s, show_s);
        ++shown_frames_;
        const bool is_over = command_.frames && shown_frames_ >= *command_.frames;
        const bool has_played = !script_.is_empty() && script_.has_ended();
        if (is_over || (has_played && !command_.frames)) state_.wants_close = true;
        files_.finish_open();
    }

    const Clock::time_point start_ = Clock::now();
    const ViewCommand& command_;
    ScriptPlayer script_;
    std::filesystem::path memory_file_;
    WindowMemory memory_;  // of the last run, until there is a view state
    FileWatch watch_;      // of the first input
    Scene scene_;
    Window window_;
    Device device_;
    Presenter presenter_;
    UserInterface interface_;
    LivePicture picture_;
    ViewState state_;
    SceneFiles files_;
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
