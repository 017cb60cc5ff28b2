#include "voxelizer/whole_section.h"

#include <algorithm>
#include <cmath>

namespace voxilux {
namespace {

using Section = SectionTable::Section;

// The points where the plane n . p = d crosses the edges of the unit cube around the origin bound its
// section, the part of the plane inside the cube. Computed by fans around the mean of these points.
Section cut_cube(glm::vec3 n, float d) {
    std::array<glm::vec3, 12> corners;
    int count = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (int side = 0; side < 4; ++side) {
            glm::vec3 p(0.0f);
            p[u] = (side & 1) != 0 ? 0.5f : -0.5f;
            p[v] = (side & 2) != 0 ? 0.5f : -0.5f;
            if (n[axis] == 0.0f) continue;
            p[axis] = (d - n[u] * p[u] - n[v] * p[v]) / n[axis];
            if (std::abs(p[axis]) <= 0.5f) corners[static_cast<std::size_t>(count++)] = p;
        }
    }
    if (count < 3) return {.centre = glm::vec3(0.5f) * glm::sign(n), .area = 0.0f};
    // Projected along z, where the normal is largest.
    glm::vec3 middle(0.0f);
    for (int i = 0; i < count; ++i)
        middle += corners[static_cast<std::size_t>(i)] / static_cast<float>(count);
    const auto end = corners.begin() + count;
    std::sort(corners.begin(), end, [&](glm::vec3 a, glm::vec3 b) {
        return std::atan2(a.y - middle.y, a.x - middle.x) < std::atan2(b.y - middle.y, b.x - middle.x);
    });
    float twice = 0.0f;
    glm::vec3 moment(0.0f);
    for (int i = 0; i < count; ++i) {
        const glm::vec3 a = corners[static_cast<std::size_t>(i)] - middle;
        const glm::vec3 b = corners[static_cast<std::size_t>((i + 1) % count)] - middle;
        const float part = a.x * b.y - a.y * b.x;
        twice += part;
        moment += (a + b) * part;
    }
    if (!(twice > 0.0f)) return {.centre = middle, .area = 0.0f};
    return {.centre = middle + moment / (3.0f * twice), .area = 0.5f * twice * glm::length(n) / n.z};
}

}  // namespace

SectionTable::SectionTable() {
    sections_.reserve(std::size_t{kSlopes} * kSlopes * kDistances);
    for (int small = 0; small < kSlopes; ++small) {
        for (int middle = 0; middle < kSlopes; ++middle) {
            const glm::vec3 n((static_cast<float>(small) + 0.5f) / kSlopes,
                              (static_cast<float>(middle) + 0.5f) / kSlopes, 1.0f);
            const float farthest = 0.5f * (n.x + n.y + n.z);
            for (int step = 0; step < kDistances; ++step)
                sections_.push_back(cut_cube(n, farthest * (static_cast<float>(step) + 0.5f) / kDistances));
        }
    }
}

const Section* SectionTable::sections_of(float small, float middle) const {
    const auto step = [](float slope) {
        return std::clamp(static_cast<int>(slope * kSlopes), 0, kSlopes - 1);
    };
    return sections_.data() + (step(small) * kSlopes + step(middle)) * kDistances;
}

PlaneSections::PlaneSections(const SectionTable& table, const std::array<glm::vec3, 3>& triangle) {
    const glm::vec3 n = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const glm::vec3 size = glm::abs(n);
    std::array<int, 3> order = {0, 1, 2};
    std::ranges::stable_sort(order, {}, [&](int axis) { return size[axis]; });
    if (size[order[2]] > 0.0f) normal_ = n / size[order[2]];
    corner_ = triangle[0];
    barycentric_ = barycentric_slopes(triangle[1] - corner_, triangle[2] - corner_);
    offset_ = glm::dot(normal_, corner_);
    for (std::size_t i = 0; i < 3; ++i)
        towards_[i][order[i]] = normal_[order[i]] < 0.0f ? -1.0f : 1.0f;
    slope_ = {std::abs(normal_[order[0]]), std::abs(normal_[order[1]])};
    to_step_ = SectionTable::kDistances / (0.5f * (slope_.x + slope_.y + 1.0f));
    sections_ = table.sections_of(slope_.x, slope_.y);
}

std::optional<CellPiece> PlaneSections::at(glm::vec3 cell) const {
    const glm::vec3 middle = cell + 0.5f;
    const float distance = offset_ - glm::dot(normal_, middle);
    const int step = std::min(static_cast<int>(std::abs(distance) * to_step_), SectionTable::kDistances - 1);
    const Section& section = sections_[step];
    const float side = distance < 0.0f ? -1.0f : 1.0f;
    const glm::vec2 shift = glm::vec2(section.centre) * side;
    // The last component follows from the plane.
    const glm::vec3 centre = middle + towards_[0] * shift.x + towards_[1] * shift.y +
                             towards_[2] * (distance - glm::dot(slope_, shift));
    const float b = glm::dot(barycentric_[0], centre - corner_);
    const float c = glm::dot(barycentric_[1], centre - corner_);
    if (!(b >= 0.0f && c >= 0.0f && b + c <= 1.0f)) return std::nullopt;
    return CellPiece{.area = section.area, .centre = centre};
}

}  // namespace voxilux
