#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <new>

#include "base/error.h"
#include "compare/compare.h"
#include "devices/devices.h"
#include "info/info.h"
#include "plan/plan.h"
#include "render/render.h"

namespace {

using namespace voxilux;

int run_command(int argc, char** argv) {
    CLI::App app{"voxilux: renders voxel scenes with Vulkan compute, with or without a GPU", "voxilux"};
    app.set_version_flag("--version", VX_VERSION);
    app.require_subcommand(1);

    RenderCommand render;
    PlanCommand plan;
    InfoOptions info;
    DevicesCommand devices;
    CompareOptions compare;
    const CLI::App* const render_app = add_render(app, render);
    const CLI::App* const plan_app = add_plan(app, plan);
    const CLI::App* const info_app = add_info(app, info);
    const CLI::App* const devices_app = add_devices(app, devices);
    const CLI::App* const compare_app = add_compare(app, compare);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool is_answer = error.get_exit_code() == 0;  // --help, --version
        app.exit(error);
        return is_answer ? 0 : static_cast<int>(ExitCode::usage);
    }
    if (render_app->parsed()) return run_render(render);
    if (plan_app->parsed()) return run_plan(plan);
    if (info_app->parsed()) return run_info(info);
    if (devices_app->parsed()) return run_devices(devices);
    VX_ASSERT(compare_app->parsed());
    return run_compare(compare);
}

int report(ExitCode code, const char* message) {
    fmt::print(stderr, "voxilux: {}\n", message);
    return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run_command(argc, argv);
    } catch (const Error& error) {
        return report(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return report(ExitCode::out_of_memory, "out of memory; try a smaller picture or scene");
    } catch (const std::exception& error) {
        return report(ExitCode::internal, error.what());
    }
}
