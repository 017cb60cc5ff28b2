#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace voxilux {

// A compiled shader inside the binary. `name` is the stem of its file: passes/ao_trace.comp is "ao_trace".
struct EmbeddedShader {
    std::string_view name;
    std::span<const std::uint32_t> spirv;
};

// Entry points of shaders/passes.
[[nodiscard]] std::span<const EmbeddedShader> pass_shaders();

// Entry points of shaders/window, which belong to graphics pipelines.
[[nodiscard]] std::span<const EmbeddedShader> window_shaders();

// Entry points of shaders/probe; only tests link them.
[[nodiscard]] std::span<const EmbeddedShader> probe_shaders();

}  // namespace voxilux
