#pragma once

#include <span>

#include "scene/vox_file.h"
#include "world/voxel_world.h"

namespace voxilux {

// The file with the voxels that its scene has in `world`, whose materials are `materials`. Only what differs
// is changed: a cell goes into the last of the visible models around it, or into a new model where there is
// none; all other chunks stay. Throws Error(input_refused) for an animated file, where a model that is shown
// more than once would change, for a material that the palette lacks, and for a graph that new models cannot
// be added to.
[[nodiscard]] VoxFile with_voxels(const VoxFile& file, const VoxelWorld& world,
                                  std::span<const Material> materials);

}  // namespace voxilux
