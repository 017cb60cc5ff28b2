#include "tradeoff/page_maker.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/error.h"

extern char** environ;

namespace voxilux {
namespace {

namespace fs = std::filesystem;

// The one of the user's path first; that of the system is where Debian's packages go.
constexpr std::array<const char*, 2> kPythons = {"python3", "/usr/bin/python3"};

struct Pipe {
    int read = -1;
    int write = -1;

    Pipe() {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0)
            throw Error(ExitCode::temporary, fmt::format("cannot make a pipe: {}", std::strerror(errno)));
        read = ends[0];
        write = ends[1];
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        close_end(read);
        close_end(write);
    }
    static void close_end(int& end) {
        if (end >= 0) ::close(end);
        end = -1;
    }
};

void feed(Pipe& pipe, std::string_view text) {
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t n = ::write(pipe.write, text.data() + done, text.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) break;
        done += static_cast<std::size_t>(n);
    }
    Pipe::close_end(pipe.write);
}

struct FileActions {
    posix_spawn_file_actions_t actions;

    FileActions() { posix_spawn_file_actions_init(&actions); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
    ~FileActions() { posix_spawn_file_actions_destroy(&actions); }
};

// Starts a program with these words and `text` on its standard input; its exit code, or an errno as a
// negative number when it did not start.
int run_program(std::vector<std::string> words, std::string_view text, bool is_silent) {
    Pipe pipe;
    FileActions files;
    posix_spawn_file_actions_adddup2(&files.actions, pipe.read, STDIN_FILENO);
    if (is_silent) posix_spawn_file_actions_addopen(&files.actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    const int failure =
        ::posix_spawnp(&child, arguments.front(), &files.actions, nullptr, arguments.data(), environ);
    if (failure != 0) return -failure;
    Pipe::close_end(pipe.read);
    feed(pipe, text);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

// The first Python that has matplotlib; empty without one. It is isolated (-I): else a matplotlib.py that
// lies in the current folder would run.
std::string python_with_matplotlib() {
    for (const char* python : kPythons)
        if (run_program({python, "-I", "-c", "import matplotlib"}, "", true) == 0) return python;
    return "";
}

}  // namespace

void make_page(const fs::path& json, const fs::path& page) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ExitCode::cannot_write,
                    fmt::format("{}: cannot write: {} (--no-page makes none; all other files are there)",
                                page.string(), why));
    };
    const std::string python = python_with_matplotlib();
    if (python.empty()) refuse("there is no python3 with matplotlib: apt-get install python3-matplotlib");
    const fs::path temporary = page.string() + ".part";
    const int code =
        run_program({python, "-I", "-", json.string(), temporary.string()}, page_source(), false);
    std::error_code failure;
    if (code == 0) fs::rename(temporary, page, failure);
    if (code == 0 && !failure) return;
    std::error_code ignored;
    fs::remove(temporary, ignored);
    refuse(code == 0 ? failure.message() : fmt::format("the page maker ended with code {}", code));
}

}  // namespace voxilux
