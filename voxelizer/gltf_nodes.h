#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "voxelizer/gltf_document.h"
#include "voxelizer/mesh.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {

// A mesh of the file and its transform: world = matrix * local.
struct PlacedMesh {
    std::size_t mesh = 0;
    glm::dmat4 matrix{1.0};
};

struct PlacedNodes {
    std::vector<PlacedMesh> meshes;
    std::vector<MeshCamera> cameras;
};

// What is placed in one scene: `scene`, else the file's own choice, else its first; in a file without scenes,
// every visible node, once for each instance. Orthographic cameras and skins are noted and left out. Throws
// MeshFault for a scene that does not exist, and for a node that is reached twice: a cycle, or two parents.
// Source: glTF 2.0, section 3.5.
[[nodiscard]] PlacedNodes place_nodes(const GltfDocument& document, std::optional<std::size_t> scene,
                                      MeshNotes& notes);

}  // namespace voxilux
