#include "scene/voxel_grid.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "base/assert.h"
#include "base/checked_cast.h"

namespace voxilux {
namespace {

// Joins boxes that lie face to face along an axis, layer by layer in order of that axis.
class BoxJoiner {
  public:
    explicit BoxJoiner(int axis) : axis_(axis) {}

    void add(std::vector<VoxelBox> layer) {
        const auto section = [&](const VoxelBox& box) { return section_of(box); };
        std::ranges::sort(layer, {}, section);
        auto before = open_.begin();
        for (VoxelBox& box : layer) {
            for (; before != open_.end() && section(*before) < section(box); ++before)
                closed_.push_back(*before);
            if (before == open_.end() || section(*before) != section(box)) continue;
            if (before->cells.hi[axis_] != box.cells.lo[axis_]) continue;
            box.cells.lo[axis_] = before->cells.lo[axis_];
            ++before;
        }
        closed_.insert(closed_.end(), before, open_.end());
        open_ = std::move(layer);
    }

    // All boxes. The joiner is empty again.
    [[nodiscard]] std::vector<VoxelBox> take() {
        add({});
        return std::exchange(closed_, {});
    }

  private:
    // What is equal in boxes that can be joined.
    [[nodiscard]] std::tuple<int, int, int, int, int, int, int> section_of(const VoxelBox& box) const {
        glm::ivec3 lo = box.cells.lo, hi = box.cells.hi;
        lo[axis_] = hi[axis_] = 0;
        return {lo.x, hi.x, lo.y, hi.y, lo.z, hi.z, box.material};
    }

    int axis_;
    std::vector<VoxelBox> open_;  // of the last layer, in order of their sections
    std::vector<VoxelBox> closed_;
};

}  // namespace

void VoxelGrid::fill_row(int x0, int x1, glm::ivec2 yz, std::optional<std::uint16_t> material) {
    if (x0 >= x1) return;
    VX_ASSERT(std::min({x0, yz.x, yz.y}) >= -kMaxGridCoordinate);
    VX_ASSERT(std::max({x1 - 1, yz.x, yz.y}) < kMaxGridCoordinate);
    const auto place = rows_.try_emplace({yz.x, yz.y}).first;
    Row& row = place->second;
    // The runs that the new cells cover or touch, and what becomes of them: at most a run before the cells,
    // the cells, and a run after them.
    const auto first = std::ranges::partition_point(row, [&](const Run& run) { return run.x1 < x0; });
    const auto last = std::partition_point(first, row.end(), [&](const Run& run) { return run.x0 <= x1; });
    std::array<Run, 3> parts;
    std::size_t count = 0;
    const auto add = [&](const Run& run) {
        if (run.x0 >= run.x1) return;
        if (count > 0 && parts[count - 1].x1 == run.x0 && parts[count - 1].material == run.material) {
            parts[count - 1].x1 = run.x1;
        } else {
            parts[count++] = run;
        }
    };
    if (first != last) add({first->x0, std::min(first->x1, x0), first->material});
    if (material) add({x0, x1, *material});
    if (first != last) add({std::max((last - 1)->x0, x1), (last - 1)->x1, (last - 1)->material});
    const auto kept = std::min(count, static_cast<std::size_t>(last - first));
    std::copy_n(parts.begin(), kept, first);
    const auto rest = first + static_cast<std::ptrdiff_t>(kept);
    if (kept < count) {
        row.insert(rest, parts.begin() + kept, parts.begin() + count);
    } else {
        row.erase(rest, last);
    }
    if (row.empty()) rows_.erase(place);
}

std::optional<int> VoxelGrid::top_of_column(int x, int y) const {
    for (auto row = rows_.lower_bound({y + 1, -kMaxGridCoordinate});
         row != rows_.begin() && (--row)->first.first == y;) {
        const auto run = std::ranges::partition_point(row->second, [&](const Run& r) { return r.x1 <= x; });
        if (run != row->second.end() && run->x0 <= x) return row->first.second;
    }
    return std::nullopt;
}

std::vector<VoxelBox> VoxelGrid::boxes() const {
    BoxJoiner along_z(2), along_y(1);
    int y = 0;
    for (const auto& [yz, row] : rows_) {
        if (yz.first != y) along_y.add(along_z.take());
        y = yz.first;
        std::vector<VoxelBox> layer;
        layer.reserve(row.size());
        for (const Run& run : row)
            layer.push_back({{{run.x0, y, yz.second}, {run.x1, y + 1, yz.second + 1}}, run.material});
        along_z.add(std::move(layer));
    }
    along_y.add(along_z.take());
    return along_y.take();
}

void VoxelGrid::append_to(Scene& scene, const std::string& name) const {
    VoxelModel model{.name = name, .boxes = boxes()};
    if (model.boxes.empty()) return;
    Box bounds;
    for (const VoxelBox& box : model.boxes)
        bounds = united(bounds, box.cells);
    for (VoxelBox& box : model.boxes)
        box.cells = {box.cells.lo - bounds.lo, box.cells.hi - bounds.lo};
    model.size = bounds.hi - bounds.lo;
    // With the pivot at size / 2, cell v lands on bounds.lo + v.
    scene.instances.push_back({.model = checked_cast<std::uint32_t>(scene.models.size(), "model index"),
                               .translation = bounds.lo + model.size / 2});
    scene.models.push_back(std::move(model));
}

}  // namespace voxilux
