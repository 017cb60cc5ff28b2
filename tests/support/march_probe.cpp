#include "support/march_probe.h"

#include <fmt/format.h>

#include <span>

#include "base/checked_cast.h"
#include "passes/world.h"
#include "support/device_fixture.h"

namespace voxilux::test {
namespace {

struct MarchPush {
    std::uint32_t count;
    glm::ivec3 chunks;
};

// A buffer has at least one word, also where a level of the structure has no cells.
std::vector<std::uint32_t> words_or_zero(const std::vector<std::uint32_t>& words) {
    return words.empty() ? std::vector<std::uint32_t>{0} : words;
}

template <class T>
void upload(Recording& recording, const std::string& name, const std::vector<T>& values) {
    recording.declare({.name = name, .size_bytes = values.size() * sizeof(T)});
    recording.upload(name, std::as_bytes(std::span(values)));
}

}  // namespace

std::vector<gpu::MarchProbe> march_on_device(const MarchWorld& march_world, const std::vector<gpu::Ray>& rays,
                                             WorldAccess access) {
    if (rays.empty()) return {};
    const auto count = checked_cast<std::uint32_t>(rays.size(), "rays");
    Recording recording;
    upload(recording, "probe.roots", words_or_zero(march_world.roots));
    upload(recording, "probe.nodes", words_or_zero(march_world.nodes));
    upload(recording, "probe.leaves", words_or_zero(march_world.leaves));
    upload(recording, "probe.rays", rays);
    recording.declare({.name = "probe.unused", .size_bytes = 4});
    recording.declare({.name = "probe.marched", .size_bytes = count * sizeof(gpu::MarchProbe)});
    Dispatch dispatch{.label = "probe.march",
                      .shader = "march",
                      .extent = {count, 1, 1},
                      .bindings = {{"In", "probe.rays"}, {"Out", "probe.marched"}},
                      .push = to_bytes(MarchPush{count, march_world.chunks_size})};
    point_to_world(march_world.traversal,
                   {.roots = "probe.roots",
                    .nodes = "probe.nodes",
                    .leaves = "probe.leaves",
                    .have_texels = access == WorldAccess::texels,
                    .unused = "probe.unused"},
                   dispatch);
    recording.dispatch(std::move(dispatch));
    recording.readback("probe.marched");
    const RunResult result = test_executor().run(recording);
    return values_of<gpu::MarchProbe>(result, "probe.marched");
}

std::vector<gpu::MarchProbe> march_in_cpp(const MarchWorld& march_world, const std::vector<gpu::Ray>& rays) {
    std::vector<gpu::MarchProbe> outputs;
    outputs.reserve(rays.size());
    for (const gpu::Ray& ray : rays)
        outputs.push_back(gpu::probe_march(march_world, ray, march_world.chunks_size));
    return outputs;
}

std::string print(const gpu::Ray& ray) {
    return fmt::format("{{{{{}, {}, {}}}, {{{}, {}, {}}}, {{{}, {}, {}}}, {}}}", ray.cell.x, ray.cell.y,
                       ray.cell.z, ray.fraction.x, ray.fraction.y, ray.fraction.z, ray.direction.x,
                       ray.direction.y, ray.direction.z, ray.t_max);
}

}  // namespace voxilux::test
