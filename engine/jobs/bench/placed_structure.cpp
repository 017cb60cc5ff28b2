#include "jobs/bench/placed_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "passes/world.h"
#include "shared/world_cell.h"
#include "world/build_fields.h"

namespace voxilux {
namespace {

std::string buffer_of(Traversal traversal, const char* part) {
    return fmt::format("bench.{}.{}", name_of(traversal), part);
}

// A buffer has at least one word, even if a level of a structure has no cells.
std::string declare(const std::string& name, std::uint64_t bytes, bool is_persistent, Recording& recording) {
    recording.declare(
        {.name = name, .size_bytes = std::max<std::uint64_t>(bytes, 4), .persistent = is_persistent});
    return name;
}

WorldBuffers declare_structure(const PlacedStructure& structure, Recording& recording) {
    const auto array = [&](const char* part, std::uint64_t bytes) {
        return declare(buffer_of(structure.traversal, part), bytes, true, recording);
    };
    return {.roots = array("roots", structure.bytes.roots),
            .nodes = array("nodes", structure.bytes.nodes),
            .leaves = array("leaves", structure.bytes.leaves),
            .have_texels = structure.have_texels,
            .unused = declare("bench.unused", 4, false, recording)};
}

void build_on_device(const PlacedStructure& placed, const MarchWorld& unexpanded, Executor& executor) {
    Recording recording;
    const GrowthNeeds needs = growth_needs(unexpanded);
    WorldBuffers buffers = declare_structure(placed, recording);
    buffers.homes = declare("bench.homes", needs.home_bytes, false, recording);
    buffers.grown = declare("bench.grown", needs.grown_bytes, false, recording);
    record_world_build(unexpanded, needs, buffers, recording);
    executor.run(recording);
}

// A lower bound of the structure's bytes, valid even if all its bricks are equal: the paper's form stores
// equal bricks once.
StructureBytes min_bytes(const VoxelWorld& world, Traversal traversal) {
    StructureBytes least = predict_bytes(take_census(world), traversal);
    if (traversal == Traversal::naadf) least.leaves = 0;
    return least;
}

// Why the device cannot march the structure; empty when it can.
std::string misfit(const StructureBytes& bytes, const DeviceLimits& limits) {
    const auto mib = [](std::uint64_t count) { return static_cast<double>(count) / (1 << 20); };
    const std::uint64_t most = max_world_array_bytes(limits);
    for (const auto& [part, count] : {std::pair("roots", bytes.roots), std::pair("nodes", bytes.nodes),
                                      std::pair("leaves", bytes.leaves)}) {
        if (count > most) {
            return fmt::format("its {} take {:.0f} MiB, the device allocates {:.0f} MiB at once", part,
                               mib(count), mib(most));
        }
    }
    return "";
}

// Sets the sizes, the access by texels and the reason; returns whether the structure fits.
bool is_fit(PlacedStructure& placed, const MarchWorld& built, const DeviceLimits& limits) {
    placed.bytes = bytes_of(built);
    placed.have_texels =
        loads_texels(limits, std::max({placed.bytes.roots, placed.bytes.nodes, placed.bytes.leaves}));
    placed.reason = misfit(placed.bytes, limits);
    return placed.reason.empty();
}

// Builds a world of one voxel, to compile the shaders of the build.
void warm_up(Traversal traversal, const DeviceLimits& limits, Executor& executor) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(1));
    world.set(glm::ivec3(8), 0);
    const MarchWorld unexpanded = build_unexpanded_world(world, traversal);
    PlacedStructure placed{.traversal = traversal};
    if (is_fit(placed, unexpanded, limits)) build_on_device(placed, unexpanded, executor);
}

void upload(const PlacedStructure& placed, const MarchWorld& built, Executor& executor) {
    Recording recording;
    const WorldBuffers buffers = declare_structure(placed, recording);
    const auto upload_words = [&](const std::string& buffer, const std::vector<std::uint32_t>& words) {
        if (!words.empty()) recording.upload(buffer, std::as_bytes(std::span(words)));
    };
    upload_words(buffers.roots, built.roots);
    upload_words(buffers.nodes, built.nodes);
    upload_words(buffers.leaves, built.leaves);
    executor.run(recording);
}

bool is_on_device(const std::string& buffer, const std::vector<std::uint32_t>& words, Executor& executor) {
    if (words.empty()) return true;
    Recording recording;
    recording.readback(declare(buffer, 4 * words.size(), true, recording));
    const RunResult result = executor.run(recording);
    return std::memcmp(result.readbacks.at(buffer).data(), words.data(), 4 * words.size()) == 0;
}

void compare_builds(const MarchWorld& built, Executor& executor) {
    if (!is_on_device(buffer_of(built.traversal, "roots"), built.roots, executor) ||
        !is_on_device(buffer_of(built.traversal, "nodes"), built.nodes, executor) ||
        !is_on_device(buffer_of(built.traversal, "leaves"), built.leaves, executor)) {
        throw InternalError(fmt::format("internal error: the device builds another '{}' than the CPU",
                                        name_of(built.traversal)));
    }
}

void place_from_device(PlacedStructure& placed, const VoxelWorld& world, const DeviceLimits& limits,
                       Executor& executor) {
    warm_up(placed.traversal, limits, executor);
    const Stopwatch watch;
    const MarchWorld unexpanded = build_unexpanded_world(world, placed.traversal);
    if (!is_fit(placed, unexpanded, limits)) return;
    build_on_device(placed, unexpanded, executor);
    placed.device_build = watch.elapsed();
}

void place_from_cpu(PlacedStructure& placed, const VoxelWorld& world, const DeviceLimits& limits,
                    Executor& executor) {
    const Stopwatch watch;
    const MarchWorld built = build_march_world(world, placed.traversal);
    placed.cpu_build = watch.elapsed().cpu;
    if (!is_fit(placed, built, limits)) return;
    if (placed.device_build)
        compare_builds(built, executor);
    else
        upload(placed, built, executor);
}

}  // namespace

PlacedStructure place_structure(const VoxelWorld& world, Traversal traversal, Builder builder,
                                const DeviceLimits& limits, Executor& executor) {
    PlacedStructure placed{.traversal = traversal,
                           .chunks = world.chunks(),
                           .reason = misfit(min_bytes(world, traversal), limits)};
    if (!placed.reason.empty()) return placed;
    try {
        if (builder != Builder::cpu) place_from_device(placed, world, limits, executor);
        if (builder != Builder::device) place_from_cpu(placed, world, limits, executor);
    } catch (const Error& error) {
        if (error.code() != ExitCode::out_of_memory) throw;
        placed.reason = error.what();
    }
    return placed;
}

void point_to_structure(const PlacedStructure& structure, Recording& recording, Dispatch& dispatch) {
    point_to_world(structure.traversal, declare_structure(structure, recording), dispatch);
}

}  // namespace voxilux
