#include "plan/plan.h"

#include "base/error.h"
#include "frame/frame.h"
#include "session/report.h"

namespace voxilux {
namespace {

// The limits of the device that was asked for; of the default CPU device when none was.
DeviceLimits limits_for(const std::string& selector) {
    if (selector.empty()) return DeviceLimits{};
    const std::vector<DeviceInfo> devices = list_devices();
    return devices[pick_device(devices, selector)].limits;
}

}  // namespace

CLI::App* add_plan(CLI::App& app, PlanCommand& command) {
    CLI::App* plan = app.add_subcommand("plan", "what a render would run, what not and why, and its memory");
    add_scene_flags(*plan, command.scene);
    plan->add_flag("--colour-only", command.colour_only, "plan for a PNG, not for an EXR with all channels");
    plan->add_flag("-v,--verbose", command.verbose, "print the commands of the first frame too");
    return plan;
}

int run_plan(const PlanCommand& command) {
    PlanRequest request = plan_request(command.scene);
    request.effects.wants_aov = !command.colour_only;
    const Scene scene = load_scene_with(command.scene);
    const PreparedScene prepared = prepare_scene(scene, request, limits_for(command.scene.device));
    write_json(command.scene.json, plan_json(scene, prepared.plan));
    if (command.scene.json == "-") return 0;
    fmt::print("{}", describe(prepared.plan));
    if (command.verbose) {
        Recording recording;
        const Slice slice{.row_count = prepared.plan.slice_rows};
        record_frame(prepared.plan, slice, frame_params(prepared.plan, scene, prepared.naadf), 0, recording);
        fmt::print("{}", describe(recording));
    }
    return 0;
}

}  // namespace voxilux
