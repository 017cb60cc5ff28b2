#pragma once

#include "render/render.h"

namespace voxilux {

CLI::App* add_plan(CLI::App& app, RenderCommand& command);

// Prints what render would do with the same flags, and what not and why. Needs no device.
[[nodiscard]] int run_plan(const RenderCommand& command);

}  // namespace voxilux
