#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/vox_bytes.h"
#include "scene/vox_file.h"

namespace voxilux {

// A file while it is read.
struct VoxReading {
    VoxFile file;
    std::optional<glm::ivec3> size;         // of the SIZE chunk before
    bool size_is_used = true;               // an XYZI chunk has followed it
    std::vector<std::size_t> node_offsets;  // parallel to file.nodes: the byte where its chunk begins
    std::size_t dropped_warnings = 0;       // beyond kVoxMaxWarnings
    // Parallel to file.models: the byte behind its voxels, and how many warnings there were until then.
    struct ModelPlace {
        std::size_t end = 0;
        std::size_t warnings = 0;
    };
    std::vector<ModelPlace> model_places;

    void warn(std::size_t offset, std::string_view what);
    void keep_warning(std::string warning);
};

// Adds what one chunk says to the file; `in` is its content and is named by its id. Returns false, having
// kept the content, when no rule knows the chunk. What is odd about the voxels is left to vox_oddities.h.
// Throws VoxRefusal.
bool read_vox_chunk(VoxReading& reading, VoxBytes& in);

}  // namespace voxilux
