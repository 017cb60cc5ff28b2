#pragma once

#include <array>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/vox_file.h"

namespace voxilux {

// The material of each palette index (entry 0 is unused): its colour (sRGB), then MATT, then MATL, which
// overrides MATT. Repairs (an unknown type, a number that is not one, a value out of range) are added to
// `warnings`. emission = albedo * _emit * 2^_flux, in the units of the sky: a white surface under a plain sky
// has a radiance of 1. MagicaVoxel does not publish its rule and readers disagree; each step of its Power
// slider visibly doubles. ior = _ri, or 1 + _ior: newer files hold both, as 1.3 and 0.3.
[[nodiscard]] std::array<Material, 256> vox_materials(const VoxFile& file,
                                                      std::vector<std::string>& warnings);

}  // namespace voxilux
