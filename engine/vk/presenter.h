#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "embedded.h"
#include "vk/device.h"
#include "vk/executor.h"

namespace voxilux {

// Triangles of a user interface, in pixels of the window.
struct OverlayVertex {
    glm::vec2 position{0.0f};
    glm::vec2 texel{0.0f};  // of the font
    std::uint32_t rgba = 0;
};
struct OverlayDraw {
    glm::ivec2 first{0};  // pixels that may be drawn
    glm::ivec2 end{0};
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
};
struct Overlay {
    std::vector<OverlayVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<OverlayDraw> draws;
};

// A picture for a window, which it fills: [height][width] words of 8-bit codes.
struct ShownPicture {
    const Executor* executor = nullptr;  // whose `buffer` it is; null: there is no picture
    std::string buffer;
    glm::ivec2 size{0};  // pixels
};

// What a window showed: 8-bit codes, row 0 on top.
struct WindowCapture {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgb;
};

struct PresenterState;

// Draws a picture and a user interface into a window. It uses the queue of the executor and waits for its own
// work, so whatever it reads may be written again afterwards.
class Presenter {
  public:
    // `device` was opened for `surface`. Throws Error(no_device) when it cannot present to the window.
    Presenter(Device& device, const SurfaceSource& surface, std::span<const EmbeddedShader> shaders);
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;
    ~Presenter();

    // The codes of a picture have blue in their lowest byte, not red.
    [[nodiscard]] bool is_bgr() const;

    // How opaque each texel of the font is.
    void set_font(std::span<const std::uint8_t> coverage, glm::ivec2 size);

    // Shows the next frame in a window of so many pixels, and copies it to `capture`, if that is given.
    // False when there was nothing to show it on: the window has no pixels, or changed its size meanwhile.
    bool present(const ShownPicture& picture, const Overlay& overlay, glm::ivec2 window,
                 WindowCapture* capture = nullptr);

  private:
    std::unique_ptr<PresenterState> state_;
};

}  // namespace voxilux
