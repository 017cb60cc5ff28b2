#pragma once

#include <vector>

#include "scene/alias_table.h"
#include "scene/scene.h"
#include "shared/photon_types.h"
#include "world/box_clusters.h"

namespace voxilux {

struct LightList;

// Where photons start that are to meet mirrors or glass first (shared/photon_aim.h): a map of places on the
// disc of the sun, and one of directions for each of a few clusters of emitters. No photon that starts
// elsewhere meets anything specular before it meets something else.
struct PhotonAims {
    std::vector<gpu::AimMap> maps;        // the first is that of the sun
    std::vector<gpu::uvec2> cells;        // of all maps
    std::vector<gpu::uint> map_of_light;  // for each emitter of the list
    std::vector<gpu::AliasEntry> table;   // draws an emitter by the power that its map lets through
    double power = 0.0;                   // of the emitters, as LightList::power, what the maps let through
    glm::dvec3 max_power{0.0};            // likewise
    double sun_area = 0.0;                // of the marked part of the disc, voxels^2
};

[[nodiscard]] PhotonAims find_photon_aims(const Scene& scene, const LightList& lights, glm::ivec3 origin);

// Directions in which a box is seen from the points of another, so far as one cone holds them.
struct AimCone {
    glm::dvec3 axis{0.0, 0.0, 1.0};  // unit
    double half_angle = 0.0;         // pi: all directions

    bool operator==(const AimCone&) const = default;
};
[[nodiscard]] AimCone cone_towards(const RoundedBox& seen, const RoundedBox& from);

// Half the turn around the z axis that the cone covers at heights z in [low, high], and 0 where it covers
// none.
[[nodiscard]] double half_turn(const AimCone& cone, double low, double high);

}  // namespace voxilux
