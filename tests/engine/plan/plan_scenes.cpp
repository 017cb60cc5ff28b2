#include "engine/plan/plan_scenes.h"

#include <algorithm>

#include "formats/scene_toml.h"
#include "frame/frame.h"
#include "passes/upload.h"

namespace voxilux::test {
namespace fs = std::filesystem;

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(VX_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
    std::ranges::sort(names);
    return names;
}

fs::path scene_path(const std::string& name) {
    return fs::path(VX_SOURCE_DIR) / "scenes" / (name + ".toml");
}

Scene repository_scene(const std::string& name, const std::vector<std::string>& overrides) {
    return load_scene(scene_path(name), {.overrides = overrides});
}

PlanRequest exr_request() {
    PlanRequest request;
    request.effects.wants_aov = true;
    return request;
}

PlanRequest with_switch(PlanRequest request, Effect effect, Switch choice) {
    request.effects.switches[effect] = choice;
    return request;
}

RenderPlan plan_of(const Scene& scene, const PlanRequest& request) {
    return prepare_scene(scene, request, DeviceLimits{}).plan;
}

std::map<std::string, std::uint64_t> planned_counts(const Footprint& needs) {
    std::map<std::string, std::uint64_t> counts;
    for (const PlannedPass& pass : needs.passes)
        VX_ASSERT(counts.emplace(pass.label, pass.count).second);
    return counts;
}

namespace {

void add(RecordedRender& render, Recording recording) {
    for (const BufferProxy& proxy : recording.buffers()) {
        const auto [known, is_new] = render.buffers.emplace(proxy.name, proxy);
        if (!is_new) VX_ASSERT(known->second == proxy);
    }
    for (const Command& command : recording.commands()) {
        const auto* dispatch = std::get_if<Dispatch>(&command);
        if (const auto* indirect = std::get_if<DispatchIndirect>(&command)) dispatch = &indirect->dispatch;
        if (dispatch == nullptr) continue;
        ++render.dispatches[dispatch->label];
        render.shaders.insert(dispatch->shader);
    }
    render.recordings.push_back(std::move(recording));
}

}  // namespace

RecordedRender record_render(const Scene& scene, const PreparedScene& prepared) {
    const RenderPlan& plan = prepared.plan;
    RecordedRender render;
    Recording start;
    record_scene_upload(plan, scene, prepared.march_world, prepared.lights, start);
    record_film_clear(plan, start);
    add(render, std::move(start));
    const gpu::FrameParams params = frame_params(plan, scene, prepared.march_world);
    const auto height = static_cast<std::uint32_t>(plan.settings.size.y);
    for (std::uint32_t sample = 0; sample < plan.settings.spp; ++sample) {
        for (std::uint32_t row = 0; row < height;) {
            const std::uint32_t film_tile = row / plan.film_tile_rows;
            const std::uint32_t film_tile_end = std::min(height, (film_tile + 1) * plan.film_tile_rows);
            const DispatchTile tile{.film_tile = film_tile,
                                    .film_tile_first_row = film_tile * plan.film_tile_rows,
                                    .first_row = row,
                                    .row_count = std::min(plan.tile_rows, film_tile_end - row)};
            Recording recording;
            record_frame(plan, tile, params, {sample, {}}, recording);
            add(render, std::move(recording));
            row += tile.row_count;
        }
    }
    return render;
}

}  // namespace voxilux::test
