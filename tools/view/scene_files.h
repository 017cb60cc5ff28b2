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

// Where the window of this command remembers: scripts do the same again, so they remember only what they are
// told to.
[[nodiscard]] std::filesystem::path memory_file_of(const ViewCommand& command);

// The scene of the command, whose settings have the size of the window.
[[nodiscard]] Scene first_scene(const ViewCommand& command, const WindowMemory& memory);

// The files that the window shows, one after the other. All but show() turn errors into messages; the picture
// stays as it was then.
class SceneFiles {
  public:
    // All of them outlive this.
    SceneFiles(const ViewCommand& command, std::filesystem::path memory_file, Window& window,
               ViewState& state)
        : command_(command), memory_file_(std::move(memory_file)), window_(window), state_(state) {}

    // `watch` began before the input was read. Standard input is neither watched nor remembered. Throws as
    // LivePicture::load.
    void show(Scene scene, const std::string& input, const FileWatch& watch);

    // What somebody drops or chooses: a scene is shown, a mesh a little later, and an image is compared
    // with.
    void open(const std::string& file);
    // A frame was shown: two of them say of a mesh that it will be voxelized.
    void finish_open();
    [[nodiscard]] bool is_busy() const { return !mesh_.empty(); }

    // Follows the file: loads it again when somebody writes it, and no edit is unsaved.
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
    std::optional<Camera> own_camera_;  // that the file names
    FileWatch watch_;
    Playback playback_;
    std::string refused_;  // a file that unsaved edits kept away
    std::string mesh_;     // to be voxelized
    int frames_to_say_ = 0;
};

}  // namespace voxilux
