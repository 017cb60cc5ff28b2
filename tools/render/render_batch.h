#pragma once

#include "render/render.h"

namespace voxilux {

// Whether a command asks for more than one picture or frame range: several inputs or cameras, or a sheet.
[[nodiscard]] bool is_batch(const RenderCommand& command);

// Renders every input from every camera, on one device. A file that cannot be rendered does not stop the
// others; however it ends, the sheet and the JSON are of the pictures that are written. Returns the exit code
// of the first that failed, or done.
[[nodiscard]] int render_batch(const RenderCommand& command);

}  // namespace voxilux
