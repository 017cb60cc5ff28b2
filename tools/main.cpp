#include <cstdio>

#include "command_line.h"
#include "exit_message.h"

namespace {

using namespace voxilux;

int report(const ExitMessage& message) {
    fmt::print(stderr, "voxilux: {}\n", message.text);
    return static_cast<int>(message.code);
}

// Results that went to a full disk are no results.
int checked_output(int code) {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    return report({ExitCode::cannot_write, "cannot write to standard output"});
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return checked_output(run_command_line(argc, argv));
    } catch (const std::exception& error) {
        if (std::ferror(stdout) != 0) return checked_output(0);
        return report(exit_message_of(error));
    }
}
