#pragma once

#include "passes/plane.h"
#include "scene/scene.h"

namespace voxilux {

// The texels of the image of the sky, and the table that draws them, or placeholders (lib/sky_image.glsl).
[[nodiscard]] std::string sky_texels_buffer(const RenderPlan& plan, Recording& recording);
[[nodiscard]] std::string sky_table_buffer(const RenderPlan& plan, Recording& recording);
[[nodiscard]] std::vector<Constant> sky_image_constants(const RenderPlan& plan);

// Uploads both, and the light of the six faces where occlusion is found apart from it. Records nothing
// without an image.
void record_sky_image(const RenderPlan& plan, const Sky& sky, Recording& recording);

}  // namespace voxilux
