#include "scene/scene.h"

namespace voxilux {

// floor(R (v + 1/2 - pivot)) + t in integers: with u = v - pivot, an axis that keeps its sign gives
// floor(u + 1/2) = u, and a mirrored one floor(-u - 1/2) = -u - 1.
glm::ivec3 world_cell(const Instance& instance, glm::ivec3 size, glm::ivec3 v) {
    const glm::ivec3 pivot = size / 2;
    const glm::ivec3 turned = instance.rotation.apply(v - pivot);
    const auto& sign = instance.rotation.sign;
    const glm::ivec3 shift{sign[0] < 0 ? 1 : 0, sign[1] < 0 ? 1 : 0, sign[2] < 0 ? 1 : 0};
    return turned - shift + instance.translation;
}

Box world_cells(const Instance& instance, glm::ivec3 size, const Box& box) {
    const glm::ivec3 a = world_cell(instance, size, box.lo);
    const glm::ivec3 b = world_cell(instance, size, box.hi - 1);
    return {glm::min(a, b), glm::max(a, b) + 1};
}

}  // namespace voxilux
