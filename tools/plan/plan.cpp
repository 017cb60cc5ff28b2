#include "plan/plan.h"

#include <utility>

#include "base/error.h"
#include "frame/footprint.h"
#include "jobs/forecast_history.h"
#include "jobs/report.h"
#include "output_files.h"
#include "plan/plan_forecast.h"
#include "render/render_output.h"
#include "render/render_part.h"

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
    const Slice slice{.row_count = prepared.plan.slice_rows};
    record_frame(prepared.plan, slice, frame_params(prepared.plan, scene, prepared.march_world), {},
                 recording);
    return describe(recording);
}

nlohmann::ordered_json frames_json(const FrameList& frames) {
    return {{"count", frames.count()}, {"first", frames.first}, {"last", frames.last}, {"step", frames.step}};
}

// Prints plan and JSON; `frames` is of the animated scene.
int print_plan(const RenderCommand& command, const FrameList& frames, const RenderPlan& plan,
               nlohmann::ordered_json json, const std::string& more) {
    if (frames.is_sequence) json["frames"] = frames_json(frames);
    write_json(command.json, json);
    if (command.quiet || command.json == "-") return 0;
    fmt::print("{}", describe(plan));
    if (frames.is_sequence)
        fmt::print("frames    {}, this is the plan of frame {}\n", frames.count(), frames.first);
    fmt::print("{}", more);
    return 0;
}

int print_history(const RenderCommand& command) {
    const nlohmann::ordered_json judged = judge_history(read_history(history_file()), kHistoryRows);
    write_json(command.json, judged);
    if (!command.quiet && command.json != "-") fmt::print("{}", describe_history(judged));
    return 0;
}

}  // namespace

CLI::App* add_plan(CLI::App& app, PlanCommand& command) {
    CLI::App* plan =
        app.add_subcommand("plan", "what render would do with the same flags, and what not and why");
    add_render_flags(*plan, command.render);
    plan->get_option("INPUT")->required(false);
    plan->add_flag("--history", command.history,
                   "how good the forecasts of past renders were; needs no INPUT");
    return plan;
}

int run_plan(const PlanCommand& plan_command) {
    const RenderCommand& command = plan_command.render;
    check_writable(command.json);
    if (plan_command.history) return print_history(command);
    if (command.scene.input.empty()) throw Error(ExitCode::usage, "INPUT is required");
    const std::vector<std::string> outputs = output_files(command);
    check_part_flags(command, outputs);
    PlanRequest request = request_of(command, outputs);
    Scene animated = scene_to_render(command);
    const FrameList frames = frames_to_render(command.scene, animated);
    if (!command.quiet) print_frame_note(command.scene, animated);
    request_frames(animated, frames, request);
    if (command.error) {
        RenderOptions options = render_options(command, outputs);
        options.plan = request;
        const PilotedPlan piloted = pilot_plan(command, animated, frames.first, options);
        return print_plan(command, frames, piloted.plan, piloted.json, piloted.text);
    }
    FramePlayer player(std::move(animated));
    const Scene& scene = player.show(frames.first);
    const PreparedScene prepared = prepare_scene(scene, request, limits_for(command.device.selector));
    return print_plan(command, frames, prepared.plan, plan_json(scene, prepared.plan),
                      command.verbose ? describe_first_frame(prepared, scene) : "");
}

}  // namespace voxilux
