#include "plan/plan.h"

#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "base/print.h"
#include "frame/footprint.h"
#include "frame/frame.h"
#include "jobs/forecast_history.h"
#include "jobs/memory_forecast.h"
#include "jobs/plan_forecast.h"
#include "jobs/report.h"
#include "render/render_batch.h"
#include "write_json.h"

namespace voxilux {
namespace {

constexpr std::size_t kHistoryRows = 10;

// The limits of the device that was asked for; of the default CPU device when none was.
DeviceLimits limits_for(const std::string& selector) {
    if (selector.empty()) return DeviceLimits{};
    const std::vector<DeviceInfo> devices = list_devices();
    return devices[pick_device(devices, selector)].limits;
}

std::string describe_first_frame(const PreparedScene& prepared, const Scene& scene) {
    Recording recording;
    const DispatchTile tile{.row_count = prepared.plan.tile_rows};
    record_frame(prepared.plan, tile, frame_params(prepared.plan, scene, prepared.march_world), {},
                 recording);
    return describe(recording);
}

nlohmann::ordered_json frames_json(const FrameList& frames) {
    return {{"count", frames.count()}, {"first", frames.first}, {"last", frames.last}, {"step", frames.step}};
}

// Prints plan and JSON; `frames` are those of the animated scene.
int print_plan(const RenderCommand& command, const FrameList& frames, const RenderPlan& plan,
               nlohmann::ordered_json json, const std::string& more) {
    if (frames.is_sequence) json["frames"] = frames_json(frames);
    write_json(command.report.json, json);
    if (!command.report.prints()) return 0;
    print_result("{}", describe(plan));
    if (frames.is_sequence)
        print_result("frames    {}, this is the plan of frame {}\n", frames.count(), frames.first);
    print_result("{}", more);
    return 0;
}

void print_scene_messages(const RenderCommand& command, const Scene& scene) {
    print_frame_note(command.scene, scene);
    for (const std::string& warning : scene.warnings)
        print_message("warning: {}\n", warning);
}

int print_history(const RenderCommand& command) {
    const nlohmann::ordered_json judged = judge_history(read_history(history_file()), kHistoryRows);
    write_json(command.report.json, judged);
    if (command.report.prints()) print_result("{}", describe_history(judged));
    return 0;
}

}  // namespace

void add_plan_flags(Flags& flags, PlanCommand& command) {
    add_render_flags(flags, command.render);
    flags.begin_group("");
    flags.add_switch("--history", command.history,
                     "how good the forecasts of past renders were; needs no INPUT");
}

int run_plan(const PlanCommand& plan_command) {
    const RenderCommand& command = plan_command.render;
    check_outputs({command.report.json}, {command.scene.input});
    if (plan_command.history) return print_history(command);
    if (command.scene.input.empty()) throw Error(ExitCode::usage, "INPUT is required");
    if (is_batch(command)) throw Error(ExitCode::usage, "plan: the plan is of one INPUT and one camera");
    const Checkpoint checkpoint = checkpoint_of(command);
    RenderOptions options = render_options(command);
    Scene animated = scene_to_render(command);
    const FrameList frames = frames_to_render(command.scene, animated);
    if (!command.report.quiet) print_scene_messages(command, animated);
    request_frames(animated, frames, options.plan);
    request_samples(command, animated, options.plan);
    use_checkpoint(checkpoint, command.resume, options);
    if (options.error_target) {
        const PilotedPlan piloted = pilot_plan(animated, frames.first, options);
        return print_plan(command, frames, piloted.plan, piloted.json, piloted.text);
    }
    FramePlayer player(std::move(animated));
    const Scene& scene = player.show(frames.first);
    const PreparedScene prepared = prepare_scene(scene, options.plan, limits_for(command.device.selector));
    const std::uint64_t bytes = end_bytes(prepared.plan, picture_use(options, 0.0));
    nlohmann::ordered_json json = plan_json(scene, prepared.plan);
    json["end_bytes"] = bytes;
    std::string text = fmt::format("host      {} MiB when the picture is written\n", (bytes + 0xFFFFF) >> 20);
    if (command.verbose) text += describe_first_frame(prepared, scene);
    return print_plan(command, frames, prepared.plan, json, text);
}

}  // namespace voxilux
