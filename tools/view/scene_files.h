#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "view/file_watch.h"
#include "view/playback.h"
#include "view/view.h"
#include "view/view_state.h"
#include "view/window.h"

namespace voxilux {

// The file in which the window of this command remembers. Scripts must give the same pictures each time, so
// they remember only where --state says so.
[[nodiscard]] std::filesystem::path memory_file_of(const ViewCommand& command);

// The scene of the command, whose settings have the size of the window.
[[nodiscard]] Scene first_scene(const ViewCommand& command, const WindowMemory& memory);

// The files that the window shows, one after the other. All but show() turn errors into messages, and the
// picture stays as it was.
class SceneFiles {
  public:
    // All arguments must outlive this.
    SceneFiles(const ViewCommand& command, std::filesystem::path memory_file, Window& window,
               ViewState& state)
        : command_(command), memory_file_(std::move(memory_file)), window_(window), state_(state) {}

    // `watch` must have begun before the input was read. Standard input is neither watched nor remembered.
    // Throws as LivePicture::load.
    void show(Scene scene, const std::string& input, const FileWatch& watch);

    // Opens a file that was dropped or chosen: a scene is shown, a mesh is voxelized a little later, and an
    // image is compared with.
    void open(const std::string& file);
    // Called after each frame that was shown. A mesh is voxelized once two frames have shown the message
    // about it.
    void finish_open();
    [[nodiscard]] bool is_busy() const { return !mesh_.empty(); }

    // Loads the file again when somebody has written it, unless there are unsaved edits.
    void follow();
    void play(double seconds);
    void remember();

  private:
    void load(const std::string& file);
    void reload();
    void take_reference(const std::string& file);

    const ViewCommand& command_;
    std::filesystem::path memory_file_;
    Window& window_;
    ViewState& state_;
    std::optional<Camera> own_camera_;  // the camera that the file names
    FileWatch watch_;
    Playback playback_;
    std::string refused_;  // a file that was refused because of unsaved edits
    std::string mesh_;     // to be voxelized
    int frames_to_say_ = 0;
};

}  // namespace voxilux
