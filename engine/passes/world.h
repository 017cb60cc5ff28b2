#pragma once

#include <string>

#include "record/recording.h"
#include "world/build_fields.h"
#include "world/edit_world.h"
#include "world/march_world.h"

namespace voxilux {

// Declared buffers that hold a world on the device. `homes` and `grown` are scratch of the distance-field
// build; growth_needs() gives their sizes.
struct WorldBuffers {
    std::string roots;
    std::string nodes;
    std::string leaves;
    std::string homes;
    std::string grown;
    bool have_texels = false;  // shaders read the arrays as texels (loads_texels)
    std::string unused;        // bound in their place where shaders do not
};

// Gives a dispatch that marches through a world or reads it the pointers, texels and constants that
// shaders/lib/world_access.glsl asks for.
void point_to_world(Traversal traversal, const WorldBuffers& buffers, Dispatch& dispatch);

// Uploads an unexpanded structure (build_unexpanded_world) and expands its empty boxes on the device;
// `growth` is its growth_needs(). The result equals build_march_world() to the bit. An unexpanded structure
// without words uploads nothing, but the same passes are recorded (for a dry recording).
void record_world_build(const MarchWorld& unexpanded, const GrowthNeeds& growth, const WorldBuffers& buffers,
                        Recording& recording);

// Uploads what an edit changed into buffers that hold the structure as it was and have room for what was
// added.
void record_world_edit(const MarchWorld& built, const WorldChanges& changes, const WorldBuffers& buffers,
                       Recording& recording);

}  // namespace voxilux
