#include "voxelizer/voxelize_mesh.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <mutex>
#include <unordered_map>

#include "base/error.h"
#include "base/parallel_blocks.h"

namespace voxilux {
namespace {

// Counts finished triangles and reports progress.
class ProgressCount {
  public:
    ProgressCount(std::size_t all, const std::function<void(double)>& tell) : all_(all), tell_(tell) {}

    void add(std::size_t part) {
        if (!tell_) return;
        const std::scoped_lock lock(telling_);
        done_ += part;
        tell_(static_cast<double>(done_) / static_cast<double>(std::max<std::size_t>(all_, 1)));
    }

  private:
    std::size_t all_;
    std::size_t done_ = 0;
    const std::function<void(double)>& tell_;
    std::mutex telling_;
};

void fill_surface(VoxelSet& set, const VoxelizeInput& input, const Bins& bins,
                  const VoxelizeRequest& request) {
    set.blocks.resize(bins.blocks.size());
    std::atomic<std::uint64_t> masked{0};
    ProgressCount progress(bins.triangles.size(), request.progress);
    for_each_block(bins.blocks.size(), thread_count(request.threads), [&] {
        return [&, scratch = BlockScratch{}](std::size_t i) mutable {
            const Block& block = bins.blocks[i];
            BlockResult result = voxelize_block(input, block, scratch);
            masked += result.masked;
            set.blocks[i] = {.low = block.low, .model = block.model, .surface = std::move(result.voxels)};
            progress.add(block.count);
        };
    });
    set.masked = masked;
}

std::uint64_t cells_between(int first, int last) {
    return ~std::uint64_t{0} >> (63 - last + first) << first;
}

// Interior rows by block; the key is the block's position in the grid of blocks.
using InteriorBlocks = std::unordered_map<std::uint64_t, std::vector<InteriorRow>>;

std::uint64_t place_key(glm::ivec3 block) {
    return (static_cast<std::uint64_t>(block.z) << 20 | static_cast<std::uint64_t>(block.y)) << 20 |
           static_cast<std::uint64_t>(block.x);
}

void add_run(const InsideRun& run, InteriorBlocks& blocks) {
    const auto row = static_cast<std::uint16_t>(run.y % kBlockCells + kBlockCells * (run.z % kBlockCells));
    for (int x = run.first; x <= run.last;) {
        const int low = x / kBlockCells * kBlockCells;
        const int last = std::min(run.last, low + kBlockCells - 1);
        std::vector<InteriorRow>& rows =
            blocks[place_key({x / kBlockCells, run.y / kBlockCells, run.z / kBlockCells})];
        if (rows.empty() || rows.back().row != row) rows.push_back({row, 0});
        rows.back().cells |= cells_between(x - low, last - low);
        x = last + 1;
    }
}

// Cells that the surface fills are not interior.
void remove_surface(VoxelBlock& block) {
    std::vector<std::uint64_t> filled(std::size_t{kBlockCells} * kBlockCells, 0);
    for (const ColouredVoxel& voxel : block.surface) {
        const int row = voxel.y % kBlockCells + kBlockCells * (voxel.z % kBlockCells);
        filled[static_cast<std::size_t>(row)] |= std::uint64_t{1} << voxel.x % kBlockCells;
    }
    for (InteriorRow& row : block.interior)
        row.cells &= ~filled[row.row];
    std::erase_if(block.interior, [](const InteriorRow& row) { return row.cells == 0; });
}

void fill_interior(VoxelSet& set, const SolidInput& input, const VoxelizeRequest& request) {
    const glm::ivec3 cells = set.grid.cells;
    InteriorBlocks interior;
    for (const InsideRun& run : inside_runs(input, request.inside, set.solid))
        add_run(run, interior);
    for (VoxelBlock& block : set.blocks) {
        const auto found = interior.find(place_key(block.low / kBlockCells));
        if (found == interior.end()) continue;
        block.interior = std::move(found->second);
        remove_surface(block);
        interior.erase(found);
    }
    for (auto& [key, rows] : interior) {
        constexpr std::uint64_t kMask = (1u << 20) - 1;
        const glm::ivec3 place{static_cast<int>(key & kMask), static_cast<int>(key >> 20 & kMask),
                               static_cast<int>(key >> 40)};
        set.blocks.push_back({.low = place * kBlockCells,
                              .model = model_of(place * kBlockCells, cells),
                              .interior = std::move(rows)});
    }
    std::ranges::sort(set.blocks, [](const VoxelBlock& a, const VoxelBlock& b) {
        const auto key = [](const VoxelBlock& block) {
            return std::array<std::uint64_t, 2>{block.model, place_key(block.low)};
        };
        return key(a) < key(b);
    });
}

void count_voxels(VoxelSet& set) {
    std::erase_if(set.blocks,
                  [](const VoxelBlock& block) { return block.surface.empty() && block.interior.empty(); });
    for (const VoxelBlock& block : set.blocks) {
        set.surface += block.surface.size();
        for (const InteriorRow& row : block.interior)
            set.interior += static_cast<std::uint64_t>(std::popcount(row.cells));
    }
}

}  // namespace

VoxelSet voxelize_mesh(const Mesh& mesh, const VoxelizeRequest& request) {
    VoxelSet set{.grid = grid_of(mesh, request.grid)};
    const std::vector<std::uint32_t> triangles = finite_triangles(mesh);
    set.dropped = mesh.triangles.size() - triangles.size();
    const std::vector<glm::ivec3> lattice = lattice_positions(mesh, set.grid);
    const Bins bins = bin_triangles(mesh, triangles, lattice, set.grid.cells);
    const MaterialSampler sampler(mesh);
    const SectionTable sections;
    const VoxelizeInput input{.mesh = mesh,
                              .lattice = lattice,
                              .triangles = bins.triangles,
                              .sampler = sampler,
                              .sections = sections,
                              .coverage = request.coverage};
    fill_surface(set, input, bins, request);
    if (request.is_solid)
        fill_interior(set, {mesh, triangles, lattice, set.grid.cells, thread_count(request.threads)},
                      request);
    count_voxels(set);
    if (set.surface + set.interior == 0)
        throw Error(ExitCode::input_refused,
                    "no voxel is left: alpha masks or thin coverage drop the whole mesh");
    return set;
}

}  // namespace voxilux
