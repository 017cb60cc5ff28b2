#include "voxelizer/solid_fill.h"

#include <algorithm>
#include <unordered_map>

#include "voxelizer/thin_cover.h"

namespace voxilux {
namespace {

// A crossing of a row, sortable: z, y, first cell whose middle lies behind it, and whether it leads out.
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

LatticeTriangle lattice_triangle(const Mesh& mesh, std::span<const glm::ivec3> lattice, std::uint32_t index) {
    const glm::uvec3 v = mesh.triangles[index].vertices;
    return {lattice[v.x], lattice[v.y], lattice[v.z]};
}

std::vector<std::uint64_t> sorted_crossings(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                                            std::span<const glm::ivec3> lattice, glm::ivec3 cells) {
    std::vector<std::uint64_t> keys;
    for (const std::uint32_t index : triangles) {
        const LatticeTriangle triangle = lattice_triangle(mesh, lattice, index);
        const LineCrossings lines(triangle, 0, false);
        if (!lines.is_seen()) continue;
        const CellBox box = cell_box(triangle, kUnit);
        for (int z = box.low.z; z <= box.high.z; ++z) {
            const CellRange rows = lines.cells_at(z, {box.low.y, box.high.y});
            for (int y = rows.first; y <= rows.last; ++y) {
                const std::int64_t behind = (lines.crossing(y, z) + kUnit / 2) >> kUnitBits;
                keys.push_back(
                    crossing_key(z, y, std::min<std::int64_t>(behind, cells.x), lines.facing() > 0));
            }
        }
    }
    std::ranges::sort(keys);
    return keys;
}

// One row's crossings to runs.
void add_runs(std::span<const std::uint64_t> keys, std::vector<InsideRun>& runs, SolidReport& report) {
    if (keys.size() % 2 != 0) {
        ++report.open_rows;
        return;
    }
    const std::uint64_t row = row_of(keys.front());
    const auto y = static_cast<int>(row & kPlaceMask);
    const auto z = static_cast<int>(row >> kPlaceBits);
    int winding = 0;
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        const int first = place_of(keys[i]);
        const int last = place_of(keys[i + 1]) - 1;
        winding += (keys[i] & 1) != 0 ? -1 : 1;
        const bool is_inside = i % 2 == 0;
        if (last < first) continue;
        if (is_inside) runs.push_back({y, z, first, last});
        if (is_inside != (winding != 0)) report.disputed += static_cast<std::uint64_t>(last - first + 1);
    }
}

struct PositionHash {
    std::size_t operator()(const glm::ivec3& p) const {
        std::uint64_t h = static_cast<std::uint32_t>(p.x);
        h = h * 0x9E3779B97F4A7C15u + static_cast<std::uint32_t>(p.y);
        h = h * 0x9E3779B97F4A7C15u + static_cast<std::uint32_t>(p.z);
        return static_cast<std::size_t>(h ^ h >> 29);
    }
};

// Vertices at one place of the lattice are one. Triangles that collapse there have no edges.
std::uint64_t count_open_edges(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                               std::span<const glm::ivec3> lattice) {
    std::unordered_map<glm::ivec3, std::uint32_t, PositionHash> numbers;
    const auto number = [&](std::uint32_t vertex) {
        return numbers.try_emplace(lattice[vertex], static_cast<std::uint32_t>(numbers.size())).first->second;
    };
    std::vector<std::uint64_t> edges;
    for (const std::uint32_t index : triangles) {
        const glm::uvec3 v = mesh.triangles[index].vertices;
        const glm::uvec3 n{number(v.x), number(v.y), number(v.z)};
        if (n.x == n.y || n.y == n.z || n.z == n.x) continue;
        for (int i = 0; i < 3; ++i) {
            const std::uint64_t a = n[i];
            const std::uint64_t b = n[(i + 1) % 3];
            edges.push_back(std::min(a, b) << 32 | std::max(a, b));
        }
    }
    std::ranges::sort(edges);
    std::uint64_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        const std::size_t start = i;
        while (i < edges.size() && edges[i] == edges[start])
            ++i;
        open += (i - start) % 2;
    }
    return open;
}

}  // namespace

std::vector<InsideRun> inside_runs(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                                   std::span<const glm::ivec3> lattice, glm::ivec3 cells,
                                   SolidReport& report) {
    report.open_edges = count_open_edges(mesh, triangles, lattice);
    const std::vector<std::uint64_t> keys = sorted_crossings(mesh, triangles, lattice, cells);
    std::vector<InsideRun> runs;
    for (std::size_t i = 0; i < keys.size();) {
        const std::size_t start = i;
        while (i < keys.size() && row_of(keys[i]) == row_of(keys[start]))
            ++i;
        add_runs(std::span(keys).subspan(start, i - start), runs, report);
    }
    return runs;
}

}  // namespace voxilux
