#include <csignal>
#include <cstdio>

#include "base/print.h"
#include "command_line.h"
#include "exit_message.h"

namespace {

using namespace voxilux;

int report(const ExitMessage& message) {
    print_message("voxilux: {}\n", message.text);
    return static_cast<int>(message.code);
}

// Results that went to a full disk are no results.
int checked_output(int code) {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    return report({ExitCode::cannot_write, "cannot write to standard output"});
}

// A closed pipe and a limit on file sizes are errors of a write like others, no reason to die with a picture
// in memory.
void let_writes_fail() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace

int main(int argc, char** argv) {
    let_writes_fail();
    try {
        return checked_output(run_command_line(argc, argv));
    } catch (const std::exception& error) {
        return report(exit_message_of(error));
    }
}
