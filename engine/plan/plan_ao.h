#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "scene/ao_settings.h"
#include "scene/scene.h"

namespace voxilux {

// The technique of occlusion, and the size of its table.
struct AoPlan {
    AoMethod method = AoMethod::brute;  // never automatic
    std::string reason;                 // one clause, shown to the user
    std::uint32_t slots = 0;            // of the table; 0 without one
    bool reprojects = false;            // cells are looked for where the last sample saw them
    bool merged = false;                // search and trace are one pass
    bool ages = false;                  // later frames evict cells of earlier ones if the table fills

    bool operator==(const AoPlan&) const = default;
    [[nodiscard]] bool uses_cells() const { return method == AoMethod::hash; }
};

// What the choice depends on besides the settings.
struct AoNeeds {
    bool has_voxels = false;
    glm::ivec3 world_size{0};                                            // cells
    std::uint64_t pixels = 0;                                            // of the image
    std::uint32_t max_rows = std::numeric_limits<std::uint32_t>::max();  // that one dispatch takes
    std::uint32_t frames = 1;                                            // that will be rendered
    bool moves_voxels = false;                                           // between these frames
    bool is_perspective = true;                                          // others are not reprojected
    bool is_cpu = true;                                                  // the device is one
    bool wants_error = false;  // an error target decides when to stop
};

// The hash for frame ranges in which voxels stay, else brute force, unless the settings name one. Throws
// Error(input_refused) when the hash is asked for and cannot be used: no voxels, a world too long for its
// keys, an image that needs more than one film tile or dispatch, more rays in a sample than are counted; and
// for options that exclude each other.
[[nodiscard]] AoPlan plan_ao(const RenderSettings& settings, const AoNeeds& needs);

}  // namespace voxilux
