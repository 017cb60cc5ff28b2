#include "voxelizer/greedy_mesh.h"

#include <algorithm>
#include <span>
#include <tuple>

#include "base/error.h"
#include "formats/voxel_cells.h"
#include "scene/vox_instances.h"

namespace voxilux {
namespace {

// Adjacent faces of one index in one row of a plane.
struct FaceRun {
    int plane = 0;
    int row = 0;  // position on the last axis
    int first = 0, last = 0;
    std::uint8_t index = 0;
};

auto face_order(const glm::ivec3& cell, int axis) {
    return std::tuple(cell[(axis + 2) % 3], cell[(axis + 1) % 3], cell[axis]);
}

// Whether b is the neighbour of a along the axis, with cells in the order of place_of.
bool is_next(const IndexedCell& a, const IndexedCell& b, int axis) {
    glm::ivec3 behind = a.cell;
    ++behind[axis];
    return behind == b.cell;
}

// The faces that point along `axis`, upwards or downwards, as runs of length one.
std::vector<FaceRun> faces_of(std::span<const IndexedCell> cells, const std::array<bool, 256>& is_clear,
                              int axis, bool is_positive) {
    std::vector<FaceRun> faces;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const IndexedCell* before_it = nullptr;
        if (is_positive && i + 1 < cells.size() && is_next(cells[i], cells[i + 1], axis))
            before_it = &cells[i + 1];
        if (!is_positive && i > 0 && is_next(cells[i - 1], cells[i], axis)) before_it = &cells[i - 1];
        const bool is_seen =
            before_it == nullptr || (is_clear[before_it->index] && !is_clear[cells[i].index]);
        if (!is_seen) continue;
        const glm::ivec3 at = cells[i].cell;
        const int first = at[(axis + 1) % 3];
        faces.push_back(
            {at[axis] + (is_positive ? 1 : 0), at[(axis + 2) % 3], first, first + 1, cells[i].index});
    }
    std::ranges::sort(faces, {}, [](const FaceRun& f) { return std::tuple(f.plane, f.row, f.first); });
    return faces;
}

std::vector<FaceRun> joined(const std::vector<FaceRun>& faces) {
    std::vector<FaceRun> runs;
    for (const FaceRun& face : faces) {
        const bool grows = !runs.empty() && runs.back().plane == face.plane && runs.back().row == face.row &&
                           runs.back().last == face.first && runs.back().index == face.index;
        if (grows)
            ++runs.back().last;
        else
            runs.push_back(face);
    }
    return runs;
}

// Joins equal runs in consecutive rows. `open` are the rectangles that end in the previous row, by their
// first cell.
class QuadMaker {
  public:
    QuadMaker(int axis, bool is_positive, std::vector<VoxelQuad>& quads)
        : axis_(axis), is_positive_(is_positive), quads_(quads) {}

    void add_row(std::span<const FaceRun> row) {
        if (row.front().plane != plane_ || row.front().row != row_ + 1) open_.clear();
        plane_ = row.front().plane;
        row_ = row.front().row;
        std::vector<std::size_t> ends;
        auto candidate = open_.begin();
        for (const FaceRun& run : row) {
            while (candidate != open_.end() && first_of(*candidate) < run.first)
                ++candidate;
            if (candidate != open_.end() && is_same(quads_[*candidate], run)) {
                ++quads_[*candidate].size.y;
                ends.push_back(*candidate);
            } else {
                ends.push_back(quads_.size());
                add(run);
            }
        }
        open_ = std::move(ends);
    }

  private:
    [[nodiscard]] int first_of(std::size_t quad) const { return quads_[quad].low[(axis_ + 1) % 3]; }
    [[nodiscard]] bool is_same(const VoxelQuad& quad, const FaceRun& run) const {
        return quad.low[(axis_ + 1) % 3] == run.first && quad.size.x == run.last - run.first &&
               quad.index == run.index;
    }
    void add(const FaceRun& run) {
        VoxelQuad quad{.size = {run.last - run.first, 1},
                       .axis = static_cast<std::uint8_t>(axis_),
                       .is_positive = is_positive_,
                       .index = run.index};
        quad.low[axis_] = run.plane;
        quad.low[(axis_ + 1) % 3] = run.first;
        quad.low[(axis_ + 2) % 3] = run.row;
        quads_.push_back(quad);
    }

    int axis_;
    bool is_positive_;
    std::vector<VoxelQuad>& quads_;
    std::vector<std::size_t> open_;
    int plane_ = 0, row_ = 0;
};

}  // namespace

std::vector<IndexedCell> cells_of_file(const VoxFile& file) {
    const auto instances = vox_instances(file).value_or_throw(ExitCode::input_refused);
    std::vector<IndexedCell> cells;
    for (const VoxInstance& instance : instances) {
        if (instance.hidden) continue;
        const VoxModel& model = file.models[instance.model];
        const Instance placed{.rotation = instance.rotation, .translation = instance.translation};
        if (model.voxels.size() > kMaxColouredCells - cells.size())
            throw Error(ExitCode::input_refused,
                        fmt::format("over {} voxels are too many for a mesh", kMaxColouredCells));
        for (const VoxVoxel& v : model.voxels) {
            if (v.index == 0 || v.x >= model.size.x || v.y >= model.size.y || v.z >= model.size.z) continue;
            cells.push_back({world_cell(placed, model.size, {v.x, v.y, v.z}), v.index});
        }
    }
    const auto place = [](const IndexedCell& c) { return face_order(c.cell, 0); };
    std::ranges::stable_sort(cells, {}, place);
    // At equal positions the last cell counts, which comes first in reverse order.
    const auto same = [](const IndexedCell& a, const IndexedCell& b) { return a.cell == b.cell; };
    cells.erase(cells.begin(), std::unique(cells.rbegin(), cells.rend(), same).base());
    return cells;
}

std::vector<VoxelQuad> greedy_quads(std::vector<IndexedCell> cells, const std::array<bool, 256>& is_clear,
                                    std::size_t max_quads) {
    std::vector<VoxelQuad> quads;
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::sort(cells, {}, [axis](const IndexedCell& c) { return face_order(c.cell, axis); });
        for (const bool is_positive : {false, true}) {
            const std::vector<FaceRun> runs = joined(faces_of(cells, is_clear, axis, is_positive));
            QuadMaker maker(axis, is_positive, quads);
            for (std::size_t i = 0; i < runs.size();) {
                const std::size_t first = i;
                while (i < runs.size() && runs[i].plane == runs[first].plane &&
                       runs[i].row == runs[first].row)
                    ++i;
                maker.add_row(std::span(runs).subspan(first, i - first));
                if (quads.size() > max_quads)
                    throw Error(ExitCode::input_refused,
                                fmt::format("over {} rectangles are too many for one mesh", max_quads));
            }
        }
    }
    return quads;
}

}  // namespace voxilux
