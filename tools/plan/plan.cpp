#include "plan/plan.h"

#include <utility>

#include "base/error.h"
#include "frame/frame.h"
#include "output_files.h"
#include "render/render_part.h"
#include "session/report.h"

namespace voxilux {
namespace {

// The limits of the device that was asked for; of the default CPU device when none was.
DeviceLimits limits_for(const std::string& selector) {
    if (selector.empty()) return DeviceLimits{};
    const std::vector<DeviceInfo> devices = list_devices();
    return devices[pick_device(devices, selector)].limits;
}

std::string describe_first_frame(const PreparedScene& prepared, const Scene& scene) {
    Recording recording;
    const Slice slice{.row_count = prepared.plan.slice_rows};
    record_frame(prepared.plan, slice, frame_params(prepared.plan, scene, prepared.march_world), {},
                 recording);
    return describe(recording);
}

nlohmann::ordered_json frames_json(const FrameList& frames) {
    return {{"count", frames.count()}, {"first", frames.first}, {"last", frames.last}, {"step", frames.step}};
}

}  // namespace

CLI::App* add_plan(CLI::App& app, RenderCommand& command) {
    CLI::App* plan =
        app.add_subcommand("plan", "what render would do with the same flags, and what not and why");
    add_render_flags(*plan, command);
    return plan;
}

int run_plan(const RenderCommand& command) {
    const std::vector<std::string> outputs = output_files(command);
    check_part_flags(command, outputs);
    PlanRequest request = request_of(command, outputs);
    check_writable(command.json);
    Scene animated = scene_to_render(command);
    const FrameList frames = frames_to_render(command.scene, animated);
    if (!command.quiet) print_frame_note(command.scene, animated);
    request.wants_error = command.error.has_value();
    request_frames(animated, frames, request);
    FramePlayer player(std::move(animated));
    const Scene& scene = player.show(frames.first);
    const PreparedScene prepared = prepare_scene(scene, request, limits_for(command.device));
    nlohmann::ordered_json json = plan_json(scene, prepared.plan);
    if (frames.is_sequence) json["frames"] = frames_json(frames);
    write_json(command.json, json);
    if (command.quiet || command.json == "-") return 0;
    fmt::print("{}", describe(prepared.plan));
    if (frames.is_sequence)
        fmt::print("frames    {}, this is the plan of frame {}\n", frames.count(), frames.first);
    if (command.verbose) fmt::print("{}", describe_first_frame(prepared, scene));
    return 0;
}

}  // namespace voxilux
