#include "view/view.h"

#include "base/error.h"
#include "parse_values.h"
#include "view/session.h"

namespace voxilux {

void add_view_flags(Flags& flags, ViewCommand& command) {
    add_scene_flags(flags, command.scene, PicturesOf::scene);
    flags.begin_group("Window");
    flags.on<double>(
        "--frame-time", "MS",
        [&command](double ms) {
            if (!(ms >= 1.0 && ms <= 10000.0)) refuse("--frame-time: from 1 to 10000 ms");
            command.frame_ms = ms;
        },
        "what a frame may take while something moves (default: as last time, else 33)");
    flags.add_parsed("--error", "E", command.error_target, parse_error_target,
                     "take samples until the estimated error is below this: 2% (however many --spp says)");
    flags.add_parsed("--time-limit", "T", command.time_limit_s, parse_duration,
                     "take samples for so long: 90s, 5m");
    flags.add("--script", "FILE", command.script, "a person's input as a .toml file; then exit");
    flags.add("--frames", "N", command.frames, "exit after showing so many frames").from_zero();
    flags.add("--screenshot", "FILE", command.screenshot,
              "write the last frame: the window (.png) or the film (.exr)");
    flags.add("--state", "FILE", command.state,
              "remember recent files, size and frame time there; without it scripts remember nothing");
    flags.add("--report", "FILE", command.report, "write times of the frames and what was shown; -: print");
    add_device_flags(flags, command.device, command.scene.request.memory_budget_bytes, "the pipeline cache");
}

int run_view(const ViewCommand& command) {
    return run_session(command);
}

}  // namespace voxilux
