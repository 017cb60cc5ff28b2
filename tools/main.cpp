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

// Results that a full disk has swallowed must not count as success.
int checked_output(int code) {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    return report({ExitCode::cannot_write, "cannot write to standard output"});
}

// A closed pipe or a limit on file sizes is a write error like any other. It must not kill a process that
// holds a picture.
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
