#include "render/print_render.h"

#include "base/error.h"
#include "base/print.h"
#include "frame/footprint.h"
#include "jobs/report.h"

namespace voxilux {

bool missed_error(const RenderCommand& command, const RenderOutcome& outcome) {
    return command.error_target && !(outcome.error().high <= *command.error_target);
}

std::string target_text(const RenderCommand& command) {
    return fmt::format("{:g}%", 100.0 * *command.error_target);
}

void print_validation(const RenderOutcome& outcome) {
    for (const std::string& message : outcome.statistics.validation)
        print_message("validation: {}\n", message);
}

void print_faults(const RenderOutcome& outcome) {
    for (const auto& [name, count] : outcome.statistics.faults) {
        if (count != 0) print_message("warning: fault {} counted {} times\n", name, count);
    }
    if (lacks_light(outcome.statistics.faults))
        print_message("warning: paths or sums were cut: light is missing, and not counted in the error\n");
}

void print_warnings(const RenderCommand& command, const RenderOutcome& outcome, std::set<std::string>& said) {
    if (command.report.quiet) return;
    for (const std::string& warning : outcome.statistics.warnings) {
        if (said.insert(warning).second) print_message("warning: {}\n", warning);
    }
    if (command.verbose) return;  // the plan that is printed has them
    for (const std::string& note : outcome.plan.notes) {
        if (said.insert(note).second) print_message("note: {}\n", note);
    }
}

void print_missed_error(const RenderCommand& command, const RenderOutcome& outcome) {
    if (command.report.quiet || !missed_error(command, outcome)) return;
    print_message(
        "warning: stopped after {} samples with an error of up to {:.3g} %, over the {} asked for\n",
        outcome.statistics.samples, 100.0 * outcome.error().high, target_text(command));
}

void print_outcome(const RenderCommand& command, const std::vector<std::string>& outputs,
                   const RenderOutcome& outcome) {
    if (!command.report.prints()) return;
    if (command.verbose) print_result("{}", describe(outcome.plan));
    print_result("{}", describe(outcome));
    for (const std::string& file : outputs)
        print_result("wrote     {}\n", file);
}

ExitCode exit_code(const RenderCommand& command, const RenderOutcome& outcome) {
    if (outcome.statistics.stop == StopReason::interrupted) return ExitCode::interrupted;
    const bool out_of_time = outcome.statistics.stop == StopReason::time_limit;
    return out_of_time && missed_error(command, outcome) ? ExitCode::time_limit : ExitCode::done;
}

}  // namespace voxilux
