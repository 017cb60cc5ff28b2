#include "voxelizer/voxelize_block.h"

#include <bit>

#include "voxelizer/cell_piece.h"
#include "voxelizer/linear_to_srgb.h"
#include "voxelizer/surface_look.h"
#include "voxelizer/thin_cover.h"

namespace voxilux {
namespace {

constexpr std::size_t kRows = std::size_t{kBlockCells} * kBlockCells;

// Weight of a piece that touches a cell in a point or a line, voxels^2: negligible beside any other piece.
constexpr float kTouchArea = 1e-9f;

std::size_t row_of(int y, int z) {
    return static_cast<std::size_t>(y + kBlockCells * z);
}

std::uint64_t bits(int first, int last) {
    return ~std::uint64_t{0} >> (63 - last + first) << first;
}

LatticeTriangle lattice_triangle(const VoxelizeInput& input, std::uint32_t index) {
    const glm::uvec3 v = input.mesh.triangles[index].vertices;
    return {input.lattice[v.x], input.lattice[v.y], input.lattice[v.z]};
}

std::array<glm::vec3, 3> corners_in_block(const LatticeTriangle& triangle, glm::ivec3 low) {
    std::array<glm::vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
        corners[i] = glm::vec3(triangle[i] - low * kUnit) / static_cast<float>(kUnit);
    return corners;
}

class BlockVoxelizer {
  public:
    BlockVoxelizer(const VoxelizeInput& input, const Block& block, BlockScratch& scratch)
        : input_(input),
          block_(block),
          s_(scratch),
          indices_(input.triangles.subspan(block.first, block.count)) {}

    BlockResult run() {
        cover();
        number_sums();
        for (std::size_t i = 0; i < indices_.size(); ++i)
            add_colours(i);
        return collect();
    }

  private:
    // Fills `touched`, `filled` and `spans`.
    void cover() {
        s_.touched.assign(kRows, 0);
        s_.shared.assign(kRows, 0);
        s_.spans.clear();
        s_.span_ends.clear();
        const CellBox box{block_.low, block_.low + (kBlockCells - 1)};
        for (const std::uint32_t index : indices_) {
            const TriangleCover cover = cover_of(lattice_triangle(input_, index), kUnit);
            for_each_span(cover, box, [&](int y, int z, int first, int last) {
                const std::size_t row = row_of(y - block_.low.y, z - block_.low.z);
                const int a = first - block_.low.x;
                const int b = last - block_.low.x;
                s_.shared[row] |= s_.touched[row] & bits(a, b);
                s_.touched[row] |= bits(a, b);
                s_.spans.push_back({static_cast<std::uint16_t>(row), static_cast<std::uint8_t>(a),
                                    static_cast<std::uint8_t>(b)});
            });
            s_.span_ends.push_back(s_.spans.size());
        }
        if (input_.coverage == Coverage::conservative) return s_.filled.swap(s_.touched);
        s_.filled.assign(kRows, 0);
        for (const std::uint32_t index : indices_) {
            for_each_crossing(lattice_triangle(input_, index), box, [&](glm::ivec3 cell) {
                const glm::ivec3 c = cell - block_.low;
                s_.filled[row_of(c.y, c.z)] |= bits(c.x, c.x);
            });
        }
    }

    void number_sums() {
        s_.first_sum.resize(kRows);
        std::uint32_t count = 0;
        for (std::size_t row = 0; row < kRows; ++row) {
            s_.first_sum[row] = count;
            count += static_cast<std::uint32_t>(std::popcount(s_.filled[row]));
        }
        s_.sums.assign(count, {});
    }

    void add_colours(std::size_t i) {
        const std::size_t begin = i == 0 ? 0 : s_.span_ends[i - 1];
        if (begin == s_.span_ends[i]) return;
        const auto corners = corners_in_block(lattice_triangle(input_, indices_[i]), block_.low);
        TrianglePieces pieces{
            .shade = TriangleShade(input_.mesh, input_.sampler, input_.mesh.triangles[indices_[i]], corners),
            .plane = PlaneSections(input_.sections, corners),
            .cutter = PieceCutter(corners)};
        for (std::size_t k = begin; k < s_.span_ends[i]; ++k)
            add_row(s_.spans[k], pieces);
    }

    struct TrianglePieces {
        TriangleShade shade;
        PlaneSections plane;
        PieceCutter cutter;
    };

    void add_row(const BlockSpan& span, TrianglePieces& pieces) {
        const std::uint64_t filled = s_.filled[span.row];
        const std::uint64_t shared = s_.shared[span.row];
        const int y = span.row % kBlockCells;
        const int z = span.row / kBlockCells;
        bool is_cut = false;
        for (std::uint64_t rest = filled & bits(span.first, span.last); rest != 0; rest &= rest - 1) {
            const int x = std::countr_zero(rest);
            const std::uint64_t bit = rest & ~(rest - 1);
            VoxelSum& sum =
                s_.sums[s_.first_sum[span.row] + static_cast<std::size_t>(std::popcount(filled & (bit - 1)))];
            if ((shared & bit) == 0) {
                // Where no other triangle touches the cell, area does not matter and no edge is near, except
                // in open meshes.
                if (const auto piece = pieces.plane.at(glm::vec3(x, y, z))) {
                    add_piece(sum, *piece, pieces.shade);
                    continue;
                }
            }
            if (!is_cut) pieces.cutter.begin_row(y, z);
            is_cut = true;
            add_piece(sum, pieces.cutter.next_cell(x), pieces.shade);
        }
    }

    static void add_piece(VoxelSum& sum, const CellPiece& piece, const TriangleShade& shade) {
        const ShadedPiece shaded = shade.at(piece);
        if (shaded.share == 0.0f) return;
        const float area = std::max(piece.area * shaded.share, kTouchArea);
        const bool is_kin = share_colours(sum.look, shaded.look);
        if (sum.look == shaded.look) {
            sum.votes += area;
        } else if (sum.votes < area) {
            sum.look = shaded.look;
            sum.votes = area - sum.votes;
            if (!is_kin) sum.colour = glm::vec3(0.0f), sum.area = 0.0f;
        } else {
            sum.votes -= area;
            if (!is_kin) return;
        }
        sum.colour += shaded.colour * area;
        sum.area += area;
    }

    BlockResult collect() const {
        BlockResult result;
        result.voxels.reserve(s_.sums.size());
        const glm::ivec3 offset = block_.low % kModelCells;
        for (std::size_t row = 0; row < kRows; ++row) {
            const VoxelSum* sum = s_.sums.data() + s_.first_sum[row];
            const auto y = static_cast<std::uint8_t>(offset.y + static_cast<int>(row % kBlockCells));
            const auto z = static_cast<std::uint8_t>(offset.z + static_cast<int>(row / kBlockCells));
            for (std::uint64_t rest = s_.filled[row]; rest != 0; rest &= rest - 1, ++sum) {
                if (sum->area == 0.0f) {
                    ++result.masked;
                    continue;
                }
                const glm::u8vec3 colour = srgb_bytes(sum->colour / sum->area);
                const auto x = static_cast<std::uint8_t>(offset.x + std::countr_zero(rest));
                result.voxels.push_back({x, y, z, colour.r, colour.g, colour.b, sum->look});
            }
        }
        return result;
    }

    const VoxelizeInput& input_;
    const Block& block_;
    BlockScratch& s_;
    std::span<const std::uint32_t> indices_;
};

}  // namespace

BlockResult voxelize_block(const VoxelizeInput& input, const Block& block, BlockScratch& scratch) {
    return BlockVoxelizer(input, block, scratch).run();
}

}  // namespace voxilux
