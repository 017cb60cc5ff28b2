#pragma once

// The scenes of this repository for tests of plans, and a whole render recorded without a device.

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "frame/footprint.h"
#include "jobs/render_session.h"
#include "record/recording.h"

namespace voxilux::test {

// Stems of all files scenes/*.toml, sorted.
[[nodiscard]] std::vector<std::string> scene_names();

[[nodiscard]] std::filesystem::path scene_path(const std::string& name);

// A scene of ours with overrides as -D gives them. Throws as load_scene.
[[nodiscard]] Scene repository_scene(const std::string& name, const std::vector<std::string>& overrides = {});

// The request that `voxilux render -o x.exr` would make.
[[nodiscard]] PlanRequest exr_request();

[[nodiscard]] PlanRequest with_switch(PlanRequest request, Effect effect, Switch choice);

// The plan alone, for the default device.
[[nodiscard]] RenderPlan plan_of(const Scene& scene, const PlanRequest& request = exr_request());

// Dispatches by label.
[[nodiscard]] std::map<std::string, std::uint64_t> planned_counts(const Footprint& needs);

// All recordings of a whole render whose tiles are no smaller than the plan's.
struct RecordedRender {
    std::vector<Recording> recordings;           // the scene and the cleared film first, then the samples
    std::map<std::string, BufferProxy> buffers;  // by name
    std::map<std::string, std::uint64_t> dispatches;  // how many of each label
    std::set<std::string> shaders;
};

// Records what the session would run. Throws InternalError when two recordings declare a buffer differently.
[[nodiscard]] RecordedRender record_render(const Scene& scene, const PreparedScene& prepared);

}  // namespace voxilux::test
