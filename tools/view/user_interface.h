#pragma once

#include <functional>
#include <memory>
#include <span>

#include <glm/glm.hpp>

#include "view/input_event.h"
#include "vk/presenter.h"

namespace voxilux {

// Dear ImGui between input events and triangles. Debian's ImGui backends are not used: the Vulkan one calls
// the loader under names that our own function pointers have, and the GLFW one reads the desktop's input,
// which scripts have to replace.
class UserInterface {
  public:
    UserInterface(Presenter& presenter, float scale);
    UserInterface(const UserInterface&) = delete;
    UserInterface& operator=(const UserInterface&) = delete;
    ~UserInterface();

    // Takes the events and begins a frame. ImGui may be called until end().
    void begin(std::span<const InputEvent> events, glm::ivec2 window, double seconds);
    [[nodiscard]] const Overlay& end();

    // Whether the event goes to the panels now. Releases never do, so that no key stays held.
    [[nodiscard]] bool wants(const InputEvent& event) const;

  private:
    Overlay overlay_;
};

}  // namespace voxilux
