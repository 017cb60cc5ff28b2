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
    glm::ivec2 first{0};  // the scissor rectangle, pixels
    glm::ivec2 end{0};
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
};
struct Overlay {
    std::vector<OverlayVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<OverlayDraw> draws;
};

// An image that fills a window: [height][width] words of 8-bit codes.
struct ShownPicture {
    const Executor* executor = nullptr;  // owner of `buffer`; null: there is no image
    std::string buffer;
    glm::ivec2 size{0};  // pixels
};

// What a window showed: 8-bit codes, row 0 on top.
struct WindowCapture {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgb;
};

struct PresenterState;

// Draws an image and a user interface into a window. It uses the executor's queue and waits for its own work,
// so the buffers that it reads may be written again afterwards.
class Presenter {
  public:
    // `device` was opened for `surface`. Throws Error(no_device) when it cannot present to the window.
    Presenter(Device& device, const SurfaceSource& surface, std::span<const EmbeddedShader> shaders);
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;
    ~Presenter();

    // Whether the codes of an image have blue in their lowest byte instead of red.
    [[nodiscard]] bool is_bgr() const;

    // The opacity of each texel of the font.
    void set_font(std::span<const std::uint8_t> coverage, glm::ivec2 size);

    // Shows the next frame in a window of `window` pixels, and copies it to `capture`, if given. False when
    // it could not be shown: the window has no pixels, or changed its size meanwhile.
    bool present(const ShownPicture& picture, const Overlay& overlay, glm::ivec2 window,
                 WindowCapture* capture = nullptr);

  private:
    std::unique_ptr<PresenterState> state_;
};

}  // namespace voxilux
