#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "record/recording.h"
#include "vk/spirv_reflect.h"

namespace voxilux {

// Where a command touches a buffer; earlier_run is whatever a previous recording did to a persistent one.
enum class Stage { compute, indirect, transfer, host, earlier_run };
inline constexpr std::size_t kStageCount = 5;

// Why two commands must not overlap.
enum class HazardKind { read_after_write, write_after_read, write_after_write };

// A dependency on earlier commands that must be ordered before `command` (an index into the Recording) may
// run.
struct Hazard {
    std::size_t command = 0;
    std::string buffer;
    HazardKind kind = HazardKind::read_after_write;
    Stage before = Stage::compute;
    Stage after = Stage::compute;

    bool operator==(const Hazard&) const = default;
};

// What the derivation must know besides the Recording.
struct BarrierContext {
    std::function<const ProgramInfo&(std::string_view shader)> program;
    std::function<bool(std::string_view buffer)> is_mapped;  // memory that the host can access; empty: none
};

// True when the transfer `command` needs no device command because the host can access the buffer's memory:
// an upload before any other use of the buffer, or a readback after every other use of it.
[[nodiscard]] bool is_direct_transfer(const Recording& recording, std::size_t command,
                                      const BarrierContext& context);

// The hazards between the commands of a recording, in order. The hazards of one command become one barrier. A
// barrier orders ALL earlier work of its stages `before` ahead of all later work of its stages `after`, so
// hazards that an earlier barrier has already resolved are not listed. Persistent buffers count as written by
// an earlier run.
[[nodiscard]] std::vector<Hazard> derive_barriers(const Recording& recording, const BarrierContext& context);

}  // namespace voxilux
