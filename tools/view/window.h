#pragma once

#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "view/input_event.h"
#include "vk/device.h"

namespace voxilux {

struct WindowState;

// A window of the desktop, by GLFW. There is one at a time.
class Window {
  public:
    // Throws Error(no_device) where there is no display.
    Window(const std::string& title, glm::ivec2 size);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    [[nodiscard]] const SurfaceSource& surface() const;

    // Events since the last call. Waits at most `wait_s` for the first one.
    [[nodiscard]] std::vector<InputEvent> poll(double wait_s);

    [[nodiscard]] glm::ivec2 size() const;  // pixels; 0 while it is minimised
    [[nodiscard]] float scale() const;      // of the monitor: 2 where letters should be twice as large
    void resize(glm::ivec2 size);
    void minimise(bool is_minimised);
    void set_title(const std::string& title);
    void set_clipboard(const std::string& text);

  private:
    std::unique_ptr<WindowState> state_;
};

}  // namespace voxilux
