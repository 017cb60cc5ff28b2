#include "interrupt.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace voxilux {
namespace {

std::atomic<bool> interrupted = false, checkpoint_wanted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

bool has_progress_line = false;  // on a terminal, the message gets a line of its own

// Only what a signal handler may call. A second signal of the kind ends the process at once.
void on_interrupt(int signal) {
    constexpr std::string_view kSaid = "voxilux: stopping in order (again: at once)\n";
    interrupted = true;
    std::signal(signal, SIG_DFL);
    if (has_progress_line) (void)!::write(STDERR_FILENO, "\n", 1);
    (void)!::write(STDERR_FILENO, kSaid.data(), kSaid.size());
}

void on_checkpoint_wanted(int) {
    checkpoint_wanted = true;
}

// What was ignored when the process began stays so: nohup and background jobs of a shell rely on it.
void handle(int signal, void (*handler)(int)) {
    if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace

const std::atomic<bool>& interrupted_by_signal() {
    has_progress_line = ::isatty(STDERR_FILENO) != 0;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        handle(signal, on_interrupt);
    return interrupted;
}

std::atomic<bool>& checkpoint_wanted_by_signal() {
    handle(SIGUSR1, on_checkpoint_wanted);
    return checkpoint_wanted;
}

}  // namespace voxilux
