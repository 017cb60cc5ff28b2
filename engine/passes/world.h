#pragma once

#include <string>

#include "record/recording.h"
#include "world/build_fields.h"
#include "world/edit_world.h"
#include "world/march_world.h"

namespace voxilux {

// Declared buffers that hold a world on the device. `homes` and `grown` are scratch of the build, of the
// sizes that growth_needs says.
struct WorldBuffers {
    std::string roots;
    std::string nodes;
    std::string leaves;
    std::string homes;
    std::string grown;
    bool have_texels = false;  // shaders read the arrays as texels (loads_texels)
    std::string unused;        // what is bound in their place where they do not
};

// Lets a dispatch march through a world or read it: gives it the pointers, texels and constants that
// shaders/lib/world_access.glsl asks for.
void point_to_world(Traversal traversal, const WorldBuffers& buffers, Dispatch& dispatch);

// Puts an unexpanded structure (build_unexpanded_world) on the device and grows its boxes there; `growth` is
// its growth_needs. The result has the bits of build_march_world. Of an unexpanded structure without words
// nothing is uploaded, but the same passes are recorded.
void record_world_build(const MarchWorld& unexpanded, const GrowthNeeds& growth, const WorldBuffers& buffers,
                        Recording& recording);

// Puts what an edit changed into buffers that hold the structure as it was and have room for what it added.
void record_world_edit(const MarchWorld& built, const WorldChanges& changes, const WorldBuffers& buffers,
                       Recording& recording);

}  // namespace voxilux
