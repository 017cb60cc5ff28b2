#pragma once

#include <vector>

#include "scene/alias_table.h"
#include "scene/scene.h"
#include "shared/gpu_types.h"
#include "world/photon_aims.h"
#include "world/voxel_world.h"

namespace voxilux {

// The disc that the sun's photons start on: it faces the sun and covers all that can be lit.
struct SunDisc {
    glm::dvec3 centre{0.0};  // local to the world
    double radius = 0.0;     // voxels

    bool operator==(const SunDisc&) const = default;
};

// All emitters of a scene: emitting spheres, and the faces of emitting voxels that no opaque voxel covers.
struct LightList {
    std::vector<gpu::LightRecord> records;  // spheres are numbered as sphere_order() says
    std::vector<gpu::AliasEntry> table;     // draws an emitter by its power
    double power = 0.0;                     // r + g + b of radiance times etendue, summed
    glm::dvec3 max_power{0.0};              // per channel, the maximum of radiance times etendue / pdf
    SunDisc sun_disc;                       // radius 0 where there is nothing to light
    std::vector<RoundedBox> specular;       // mirrors and glass that light may meet
    PhotonAims aims;                        // empty where the plan has no use for them
};

// Faces that touch glass count: glass lets light out. Throws Error(input_refused) for 2^24 emitters and more,
// which the table could not tell apart.
[[nodiscard]] LightList find_lights(const Scene& scene, const VoxelWorld* world, glm::ivec3 origin);

}  // namespace voxilux
