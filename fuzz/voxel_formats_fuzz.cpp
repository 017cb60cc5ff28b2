// libFuzzer target of the readers of other voxel formats. Property: whatever the bytes, each reader stays
// within its memory bound and either refuses with a byte offset or returns cells within the promised extent.

#include <cstdint>
#include <span>

#include "formats/voxel_cells.h"
#include "require.h"
#include "support/allocation_counter.h"

namespace {

// Small, so that small inputs can exceed the bound.
constexpr std::size_t kMost = std::size_t{1} << 16;
constexpr std::size_t kTextBytes = 4096;
constexpr std::size_t kBlockBytes = std::size_t{2} << 20;  // palettes and regions of Minecraft

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    for (const voxilux::VoxelFormat& format : voxilux::voxel_formats()) {
        const PeakAllocation peak;
        const auto voxels = voxilux::read_voxel_cells(format, bytes, kMost);
        require(peak.bytes() <= 2 * sizeof(voxilux::ColouredCell) * kMost + kTextBytes + kBlockBytes,
                "a reader takes more memory than it promises");
        if (voxels)
            require(!voxels.value().cells.empty() && voxels.value().cells.size() <= kMost,
                    "no cells or too many");
        else
            require(voxels.reason().starts_with("at byte "), "a refusal names no byte");
    }
    return 0;
}
