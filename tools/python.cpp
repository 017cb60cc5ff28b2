#include "python.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "base/error.h"

extern char** environ;

namespace voxilux {
namespace {

// The user's own Python comes first. The system's Python sees the modules of Debian's packages.
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

std::vector<char*> arguments_of(std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    return arguments;
}

[[noreturn]] void refuse_start(const std::string& python) {
    throw Error(ExitCode::temporary, fmt::format("cannot start {}: {}", python, std::strerror(errno)));
}

// A file that holds `text`, open at its beginning. It has no name, and is no pipe, because after exec nobody
// is left to fill one.
int file_with(std::string_view text, const std::string& python) {
    const int file = ::memfd_create("script", 0);
    if (file < 0) refuse_start(python);
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t n = ::write(file, text.data() + done, text.size() - done);
        if (n <= 0) refuse_start(python);
        done += static_cast<std::size_t>(n);
    }
    if (::lseek(file, 0, SEEK_SET) != 0) refuse_start(python);
    return file;
}

}  // namespace

int run_program(std::vector<std::string> words, std::string_view text, bool is_silent) {
    Pipe pipe;
    FileActions files;
    posix_spawn_file_actions_adddup2(&files.actions, pipe.read, STDIN_FILENO);
    if (is_silent) posix_spawn_file_actions_addopen(&files.actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const std::vector<char*> arguments = arguments_of(words);
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

std::string python_with(const std::vector<std::string>& modules) {
    const std::string check =
        "import importlib.util, sys; sys.exit(any(importlib.util.find_spec(m) is None for m in "
        "sys.argv[1:]))";
    for (const char* python : kPythons) {
        std::vector<std::string> words = {python, "-I", "-c", check};
        words.insert(words.end(), modules.begin(), modules.end());
        if (run_program(words, "", true) == 0) return python;
    }
    return "";
}

void become_python(const std::string& python, std::string_view script, std::string_view input) {
    const int file = file_with(script, python);
    if (::dup2(file, STDIN_FILENO) < 0) refuse_start(python);
    ::close(file);
    // Python's warnings are for developers, not for users.
    std::vector<std::string> words = {python,   "-I", "-W",
                                      "ignore", "-",  std::to_string(file_with(input, python))};
    const std::vector<char*> arguments = arguments_of(words);
    ::execvp(python.c_str(), arguments.data());
    refuse_start(python);
}

}  // namespace voxilux
