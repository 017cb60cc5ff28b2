#include "voxelizer/solid_fill.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "base/parallel_blocks.h"
#include "voxelizer/thin_cover.h"
#include "voxelizer/winding_number.h"

namespace voxilux {
namespace {

// A crossing of a row as a sort key: z, y, first cell whose centre lies behind it, and whether it leads out.
constexpr int kPlaceBits = 17;  // kMaxCells and one behind
constexpr std::uint64_t kPlaceMask = (std::uint64_t{1} << kPlaceBits) - 1;

std::uint64_t crossing_key(int z, int y, std::int64_t x, bool leads_out) {
    const auto row = static_cast<std::uint64_t>(z) << kPlaceBits | static_cast<std::uint64_t>(y);
    return (row << kPlaceBits | static_cast<std::uint64_t>(x)) << 1 | (leads_out ? 1 : 0);
}

std::uint64_t row_of(std::uint64_t key) {
    return key >> (kPlaceBits + 1);
}

int place_of(std::uint64_t key) {
    return static_cast<int>(key >> 1 & kPlaceMask);
}

LatticeTriangle lattice_triangle(const SolidInput& input, std::uint32_t index) {
    const glm::uvec3 v = input.mesh.triangles[index].vertices;
    return {input.lattice[v.x], input.lattice[v.y], input.lattice[v.z]};
}

std::vector<std::uint64_t> sorted_crossings(const SolidInput& input) {
    std::vector<std::uint64_t> keys;
    for (const std::uint32_t index : input.triangles) {
        const LatticeTriangle triangle = lattice_triangle(input, index);
        const LineCrossings lines(triangle, 0, false);
        if (!lines.is_seen()) continue;
        const CellBox box = cell_box(triangle, kUnit);
        for (int z = box.low.z; z <= box.high.z; ++z) {
            const CellRange rows = lines.cells_at(z, {box.low.y, box.high.y});
            for (int y = rows.first; y <= rows.last; ++y) {
                const std::int64_t behind = (lines.crossing(y, z) + kUnit / 2) >> kUnitBits;
                keys.push_back(
                    crossing_key(z, y, std::min<std::int64_t>(behind, input.cells.x), lines.facing() > 0));
            }
        }
    }
    std::ranges::sort(keys);
    return keys;
}

using Crossings = std::span<const std::uint64_t>;

glm::ivec2 place_of_row(std::uint64_t row) {
    return {static_cast<int>(row & kPlaceMask), static_cast<int>(row >> kPlaceBits)};
}

// Converts one row's crossings to runs by counting them. For a closed surface each row has an even number.
void add_counted_runs(Crossings keys, InsideRule rule, std::vector<InsideRun>& runs, SolidReport& report) {
    if (keys.size() % 2 != 0) {
        ++report.open_rows;
        return;
    }
    const glm::ivec2 row = place_of_row(row_of(keys.front()));
    int winding = 0;
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        const int first = place_of(keys[i]);
        const int last = place_of(keys[i + 1]) - 1;
        winding += (keys[i] & 1) != 0 ? -1 : 1;
        const bool is_odd = i % 2 == 0;
        if (last < first) continue;
        if (rule == InsideRule::parity ? is_odd : winding != 0) runs.push_back({row.x, row.y, first, last});
        if (is_odd != (winding != 0)) report.disputed += static_cast<std::uint64_t>(last - first + 1);
    }
}

std::vector<InsideRun> counted_runs(Crossings keys, InsideRule rule, SolidReport& report) {
    std::vector<InsideRun> runs;
    for (std::size_t i = 0; i < keys.size();) {
        const std::size_t start = i;
        while (i < keys.size() && row_of(keys[i]) == row_of(keys[start]))
            ++i;
        add_counted_runs(keys.subspan(start, i - start), rule, runs, report);
    }
    return runs;
}

// The cells of one row of an open mesh whose centre is inside.
class OpenRow {
  public:
    OpenRow(const WindingTree& tree, glm::ivec2 row, std::vector<InsideRun>& runs)
        : tree_(tree), row_(row), runs_(runs) {}

    // Adds cells first..last, between which the surface does not cross the row, so that the winding number
    // has no step there.
    void add_stretch(int first, int last) {
        if (last < first) return;
        constexpr int kParts = 16;
        step_ = std::max(1, (last - first) / kParts);
        const double end = winding_at(last);
        add_part(first, last, first == last ? end : winding_at(first), end);
        if (is_inside(end)) add(last, last);
    }

  private:
    // This close to the threshold, the winding number may cross it between two positions that agree.
    static constexpr double kUncertainty = 0.2;

    [[nodiscard]] double winding_at(int x) const {
        return std::abs(tree_.at(glm::dvec3(x, row_.x, row_.y) + 0.5));
    }
    static bool is_inside(double winding) { return winding > 0.5; }
    static bool is_uncertain(double winding) { return std::abs(winding - 0.5) < kUncertainty; }

    // Adds cells first..last - 1, given the winding numbers at both ends: bisected down to a step while they
    // are uncertain, and to one cell where they differ.
    void add_part(int first, int last, double at_first, double at_last) {
        if (last == first) return;
        const bool agree = is_inside(at_first) == is_inside(at_last);
        const int middle = first + (last - first) / 2;
        if (last - first == 1 || (agree && last - first <= step_)) {
            if (is_inside(at_first)) add(first, last - 1);
            return;
        }
        const double at_middle = winding_at(middle);
        const bool all_agree = agree && is_inside(at_middle) == is_inside(at_first);
        if (all_agree && !is_uncertain(at_first) && !is_uncertain(at_middle) && !is_uncertain(at_last)) {
            if (is_inside(at_first)) add(first, last - 1);
            return;
        }
        add_part(first, middle, at_first, at_middle);
        add_part(middle, last, at_middle, at_last);
    }

    void add(int first, int last) {
        const bool continues = !runs_.empty() && runs_.back().y == row_.x && runs_.back().z == row_.y &&
                               runs_.back().last == first - 1;
        if (continues)
            runs_.back().last = last;
        else
            runs_.push_back({row_.x, row_.y, first, last});
    }

    const WindingTree& tree_;
    glm::ivec2 row_;
    std::vector<InsideRun>& runs_;
    int step_ = 1;
};

// One layer of cells of an open mesh, from the crossings of its rows.
std::vector<InsideRun> open_layer_runs(const WindingTree& tree, Crossings keys, glm::ivec3 cells, int z) {
    std::vector<InsideRun> runs;
    std::size_t i = 0;
    for (int y = 0; y < cells.y; ++y) {
        OpenRow row(tree, {y, z}, runs);
        int from = 0;
        for (; i < keys.size() && place_of_row(row_of(keys[i])).x == y; ++i) {
            row.add_stretch(from, place_of(keys[i]) - 1);
            from = std::max(from, place_of(keys[i]));
        }
        row.add_stretch(from, cells.x - 1);
    }
    return runs;
}

std::vector<InsideRun> open_runs(const SolidInput& input, Crossings keys) {
    const WindingTree tree(input.mesh, input.triangles, input.lattice);
    const auto layers = static_cast<std::size_t>(input.cells.z);
    std::vector<std::vector<InsideRun>> runs(layers);
    for_each_block(layers, input.threads, [&] {
        return [&](std::size_t layer) {
            const auto z = static_cast<std::uint64_t>(layer);
            const auto first = std::ranges::lower_bound(keys, z << (2 * kPlaceBits + 1));
            const auto end = std::ranges::lower_bound(keys, (z + 1) << (2 * kPlaceBits + 1));
            runs[layer] = open_layer_runs(tree, {first, end}, input.cells, static_cast<int>(layer));
        };
    });
    std::vector<InsideRun> all;
    for (const auto& layer : runs)
        all.insert(all.end(), layer.begin(), layer.end());
    return all;
}

struct PositionHash {
    std::size_t operator()(const glm::ivec3& p) const {
        std::uint64_t h = static_cast<std::uint32_t>(p.x);
        h = h * 0x9E3779B97F4A7C15u + static_cast<std::uint32_t>(p.y);
        h = h * 0x9E3779B97F4A7C15u + static_cast<std::uint32_t>(p.z);
        return static_cast<std::size_t>(h ^ h >> 29);
    }
};

// Vertices at one lattice point are the same vertex. Triangles that collapse there have no edges.
void count_edges(const SolidInput& input, SolidReport& report) {
    std::unordered_map<glm::ivec3, std::uint32_t, PositionHash> numbers;
    const auto number = [&](std::uint32_t vertex) {
        return numbers.try_emplace(input.lattice[vertex], static_cast<std::uint32_t>(numbers.size()))
            .first->second;
    };
    std::vector<std::array<std::uint64_t, 2>> edges;  // both ends, and which comes first
    for (const std::uint32_t index : input.triangles) {
        const glm::uvec3 v = input.mesh.triangles[index].vertices;
        const glm::uvec3 n{number(v.x), number(v.y), number(v.z)};
        if (n.x == n.y || n.y == n.z || n.z == n.x) continue;
        for (int i = 0; i < 3; ++i) {
            const std::uint64_t a = n[i];
            const std::uint64_t b = n[(i + 1) % 3];
            edges.push_back({std::min(a, b) << 32 | std::max(a, b), a < b ? 1u : 0u});
        }
    }
    std::ranges::sort(edges);
    for (std::size_t i = 0; i < edges.size();) {
        const std::size_t start = i;
        std::size_t forwards = 0;
        for (; i < edges.size() && edges[i][0] == edges[start][0]; ++i)
            forwards += edges[i][1];
        const std::size_t count = i - start;
        report.open_edges += count % 2;
        report.turned_edges += count % 2 == 0 && 2 * forwards != count ? 1 : 0;
    }
}

}  // namespace

std::vector<InsideRun> inside_runs(const SolidInput& input, InsideRule rule, SolidReport& report) {
    count_edges(input, report);
    const std::vector<std::uint64_t> keys = sorted_crossings(input);
    if (rule == InsideRule::winding && report.open_edges > 0) return open_runs(input, keys);
    // Without orientation there is no winding number, only parity.
    return counted_runs(keys, report.turned_edges > 0 ? InsideRule::parity : rule, report);
}

}  // namespace voxilux
