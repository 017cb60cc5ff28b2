#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "base/checked_cast.h"
#include "record/recording.h"
#include "support/device_fixture.h"

namespace voxilux {

// Runs the shader `name` of shaders/probe once per element of `inputs` on the test device and returns what it
// wrote. Its blocks are `In` and `Out` (arrays of the two structs, scalar layout) and its push struct is {
// uint count; }.
template <class In, class Out>
[[nodiscard]] std::vector<Out> run_probe(const std::string& name, const std::vector<In>& inputs) {
    static_assert(std::is_trivially_copyable_v<In> && std::is_trivially_copyable_v<Out>);
    if (inputs.empty()) return {};
    const auto count = checked_cast<std::uint32_t>(inputs.size(), "probe inputs");
    Recording recording;
    recording.declare({.name = "probe.in", .size_bytes = count * sizeof(In)});
    recording.declare({.name = "probe.out", .size_bytes = count * sizeof(Out)});
    recording.upload("probe.in", std::as_bytes(std::span(inputs)));
    recording.dispatch({.label = "probe." + name,
                        .shader = name,
                        .extent = {count, 1, 1},
                        .bindings = {{"In", "probe.in"}, {"Out", "probe.out"}},
                        .push = to_bytes(count)});
    recording.readback("probe.out");
    return values_of<Out>(test_executor().run(recording), "probe.out");
}

}  // namespace voxilux
