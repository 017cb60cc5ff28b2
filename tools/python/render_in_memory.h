#pragma once

#include <atomic>
#include <functional>
#include <nlohmann/json.hpp>

#include "render/render.h"

namespace voxilux {

struct RenderedInMemory {
    Image image;  // the channels of an EXR
    nlohmann::ordered_json report;
};

// Renders one picture and writes no file but the pipeline cache. Ends early, with the samples so far, when
// `interrupted` becomes true. Throws Error(usage) for flags that name files, parts or several pictures.
[[nodiscard]] RenderedInMemory render_in_memory(const RenderCommand& command,
                                                const std::atomic<bool>& interrupted,
                                                const std::function<void(const Progress&)>& on_progress);

}  // namespace voxilux
