#include "plan/plan_ao.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/error.h"
#include "shared/limits.h"

namespace voxilux {
namespace {

// Pixels that one film tile may have with the hash: every pass then runs over the whole image before the next
// one starts, so that no pixel reads sums that others still add to.
constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 21;
constexpr std::uint64_t kMinSlots = std::uint64_t{1} << 12;
constexpr std::uint64_t kMaxSlots = std::uint64_t{1} << 24;  // 128 MiB of keys: what one binding takes
constexpr double kSlotsPerCell = 3.0;
constexpr double kMinCells = 2.0 / 3.0;  // per pixel
constexpr double kMaxCells = 4.0;

// Occlusion rays of a sample of the whole image: one recording counts them in 32 bits.
constexpr std::uint64_t kMaxRays = std::numeric_limits<std::uint32_t>::max();

// Why the hash cannot be used, or nothing.
std::string hindrance(const RenderSettings& settings, const AoNeeds& needs) {
    if (!needs.has_voxels) return "the scene has no voxels to share samples on";
    if (std::max({needs.world_size.x, needs.world_size.y, needs.world_size.z}) > gpu::kAoMaxEdge)
        return fmt::format("the world is longer than {} voxels", gpu::kAoMaxEdge);
    if (needs.wants_error) return "pixels that share samples give no estimate of the error";
    if (needs.pixels > kMaxPixels) return fmt::format("the picture has over {} pixels", kMaxPixels);
    if (static_cast<std::uint32_t>(settings.size.y) > needs.max_rows)
        return fmt::format("the picture has over {} rows", needs.max_rows);
    if (needs.pixels * settings.ao_rays > kMaxRays)
        return fmt::format("a sample of the picture has over {} occlusion rays", kMaxRays);
    return {};
}

// Whether some pixels take no sample, which must be known before samples are taken.
bool needs_slots_first(const AoSettings& ao) {
    return ao.checkerboard || ao.sample_limit != 0;
}

void check_options(const AoSettings& ao) {
    if (ao.merged.value_or(false) && needs_slots_first(ao))
        throw Error(
            ExitCode::input_refused,
            "[ao] 'merged' excludes 'checkerboard' and 'sample_limit': they must know the cell before the "
            "samples are taken");
    if (ao.slots != 0 && !std::has_single_bit(ao.slots))
        throw Error(ExitCode::input_refused, fmt::format("[ao] 'slots' {} is not a power of two", ao.slots));
}

// Slots for the most cells that an image shows. Cells have at least half of the desired width, but where
// voxels are smaller, each pixel may have its own. At most a third of the slots should be taken
// (kCellProbes); the others leave room for cells that were seen before, too.
std::uint32_t slots_for(const AoSettings& ao, std::uint64_t pixels) {
    if (ao.slots != 0) return ao.slots;
    const double half_width = 0.5 * static_cast<double>(ao.cell_px);
    const double cells_per_pixel = std::clamp(1.0 / (half_width * half_width), kMinCells, kMaxCells);
    const auto wanted =
        static_cast<std::uint64_t>(kSlotsPerCell * cells_per_pixel * static_cast<double>(pixels));
    return static_cast<std::uint32_t>(std::bit_ceil(std::clamp(wanted, kMinSlots, kMaxSlots)));
}

}  // namespace

AoPlan plan_ao(const RenderSettings& settings, const AoNeeds& needs) {
    const AoSettings& ao = settings.ao;
    check_options(ao);
    if (ao.method == AoMethod::brute) return {AoMethod::brute, "asked for"};
    const std::string hindered = hindrance(settings, needs);
    // On a CPU one pass is faster than two, and a search that finds its cell uses no atomics. Reprojection
    // therefore pays there only where cells are wide.
    const bool reprojects = ao.reproject.value_or(!needs.is_cpu) && needs.is_perspective;
    const AoPlan hash{.method = AoMethod::hash,
                      .reason = "asked for",
                      .slots = slots_for(ao, needs.pixels),
                      .reprojects = reprojects,
                      .merged = ao.merged.value_or(needs.is_cpu && !reprojects && !needs_slots_first(ao)),
                      .ages = needs.frames > 1};
    if (ao.method == AoMethod::hash) {
        if (hindered.empty()) return hash;
        throw Error(ExitCode::input_refused,
                    fmt::format("occlusion in a hash is asked for, but {}; use brute force", hindered));
    }
    if (needs.frames <= 1) return {AoMethod::brute, "a single picture is traced pixel by pixel"};
    if (needs.moves_voxels) return {AoMethod::brute, "frames with moving voxels share no samples"};
    if (!hindered.empty()) return {AoMethod::brute, hindered};
    AoPlan shared = hash;
    shared.reason = fmt::format("{} frames share samples", needs.frames);
    return shared;
}

}  // namespace voxilux
