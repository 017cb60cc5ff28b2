#include "bench/exposed_faces.h"

namespace voxilux {

std::vector<ExposedFace> exposed_faces(const VoxelWorld& world) {
    std::vector<ExposedFace> faces;
    world.for_each_voxel([&](glm::ivec3 cell, std::uint16_t) {
        for (gpu::uint face = 0; face < 6; ++face) {
            glm::ivec3 front = cell;
            front[static_cast<int>(face / 2)] += face % 2 == 0 ? -1 : 1;
            if (world.get(front) == VoxelWorld::kEmpty) faces.push_back({cell, face});
        }
    });
    return faces;
}

std::array<glm::vec3, 4> corners_of(const ExposedFace& face) {
    const int a = static_cast<int>(face.face / 2);
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    glm::vec3 corner(face.cell);
    if (face.face % 2 == 1) corner[a] += 1.0f;
    std::array<glm::vec3, 4> corners{corner, corner, corner, corner};
    corners[1][b] += 1.0f;
    corners[2][b] += 1.0f;
    corners[2][c] += 1.0f;
    corners[3][c] += 1.0f;
    return corners;
}

}  // namespace voxilux
