#pragma once

#include <functional>
#include <memory>
#include <span>

#include <glm/glm.hpp>

#include "view/input_event.h"
#include "vk/presenter.h"

namespace voxilux {

// Dear ImGui between events and triangles. Debian's backends are not used: the Vulkan one calls the loader's
// functions by names that are the pointers of ours, and that for GLFW asks the desktop, where scripts want a
// say.
class UserInterface {
  public:
    UserInterface(Presenter& presenter, float scale);
    UserInterface(const UserInterface&) = delete;
    UserInterface& operator=(const UserInterface&) = delete;
    ~UserInterface();

    // Feeds the events and begins a frame: ImGui may be called until end().
    void begin(std::span<const InputEvent> events, glm::ivec2 window, double seconds);
    [[nodiscard]] const Overlay& end();

    // Whether the event belongs to the panels now. Releases never do, so that nothing stays held.
    [[nodiscard]] bool wants(const InputEvent& event) const;

  private:
    Overlay overlay_;
};

}  // namespace voxilux
