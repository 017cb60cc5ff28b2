#pragma once

#include <set>
#include <string>

#include "render/render.h"

namespace voxilux {

// Whether --error was given and not reached.
[[nodiscard]] bool missed_error(const RenderCommand& command, const RenderOutcome& outcome);

// done, time_limit (before the error target) or interrupted.
[[nodiscard]] ExitCode exit_code(const RenderCommand& command, const RenderOutcome& outcome);

// The error asked for, as people write it: "1%".
[[nodiscard]] std::string target_text(const RenderCommand& command);

// Prints messages of the validation layers and faults on standard error, even when --quiet is given.
void print_validation(const RenderOutcome& outcome);
void print_faults(const RenderOutcome& outcome);

// Prints warnings and notes on standard error, except those that `said` holds because they were printed
// before.
void print_warnings(const RenderCommand& command, const RenderOutcome& outcome, std::set<std::string>& said);
void print_missed_error(const RenderCommand& command, const RenderOutcome& outcome);

// The report for people, on standard output.
void print_outcome(const RenderCommand& command, const std::vector<std::string>& files,
                   const RenderOutcome& outcome);

}  // namespace voxilux
