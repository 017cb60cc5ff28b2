#include "tools/cli/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace voxilux::test {
namespace fs = std::filesystem;

namespace {

struct Pipe {
    int read = -1;
    int write = -1;
};

Pipe make_pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("cannot make a pipe");
    return {ends[0], ends[1]};
}

// Runs between fork and exec. What fails here ends the child with a code that voxilux does not have.
[[noreturn]] void become(const std::vector<std::string>& arguments, const Surroundings& surroundings, int out,
                         int err) {
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    if (!surroundings.folder.empty() && ::chdir(surroundings.folder.c_str()) != 0) ::_exit(126);
    ::setenv("XDG_CACHE_HOME", VX_TEST_CACHE, 1);
    ::setenv("XDG_STATE_HOME", VX_TEST_CACHE "/state", 1);
    ::setenv("ASAN_OPTIONS", "detect_leaks=0", 0);  // drivers leak, and are unloaded before leaks are traced
    for (const auto& [name, value] : surroundings.environment)
        ::setenv(name.c_str(), value.c_str(), 1);
    for (const int signal : surroundings.ignored_signals)
        ::signal(signal, SIG_IGN);
    if (surroundings.largest_file > 0) {
        const rlimit limit{surroundings.largest_file, surroundings.largest_file};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (surroundings.address_space > 0) {
        const rlimit limit{surroundings.address_space, surroundings.address_space};
        ::setrlimit(RLIMIT_AS, &limit);
    }
    std::vector<char*> words{const_cast<char*>(VX_BINARY)};
    for (const std::string& argument : arguments)
        words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    ::execv(VX_BINARY, words.data());
    ::_exit(127);
}

// Appends what is there; false at the end of the stream.
bool read_some(int descriptor, std::string& text) {
    std::array<char, 65536> buffer;
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    return count > 0;
}

// -1 without a name.
int open_to_write(const fs::path& file) {
    return file.empty() ? -1 : ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
    const Pipe out = make_pipe();
    const Pipe err = make_pipe();
    const int out_file = open_to_write(surroundings.output_file);
    const int err_file = open_to_write(surroundings.error_file);
    pid_ = ::fork();
    if (pid_ == 0)
        become(arguments, surroundings, out_file >= 0 ? out_file : out.write,
               err_file >= 0 ? err_file : err.write);
    for (const int end : {out.write, err.write, out_file, err_file}) {
        if (end >= 0) ::close(end);
    }
    if (pid_ < 0) throw std::runtime_error("cannot start a process");
    out_ = out.read;
    err_ = err.read;
}

ChildProcess::~ChildProcess() {
    if (pid_ > 0) {
        ::kill(pid_, SIGKILL);
        (void)finish();
    }
}

std::string ChildProcess::wait_for_error_line() {
    while (ending_.err.find('\n') == std::string::npos && read_some(err_, ending_.err)) {
    }
    return ending_.err.substr(0, ending_.err.find('\n'));
}

bool ChildProcess::wait_for_error(const std::string& text) {
    while (ending_.err.find(text) == std::string::npos) {
        if (!read_some(err_, ending_.err)) return false;
    }
    return true;
}

void ChildProcess::send(int signal) {
    ::kill(pid_, signal);
}

Ending ChildProcess::finish() {
    std::array<pollfd, 2> streams{{{out_, POLLIN, 0}, {err_, POLLIN, 0}}};
    while (streams[0].fd >= 0 || streams[1].fd >= 0) {
        ::poll(streams.data(), streams.size(), -1);
        if (streams[0].revents != 0 && !read_some(out_, ending_.out)) streams[0].fd = -1;
        if (streams[1].revents != 0 && !read_some(err_, ending_.err)) streams[1].fd = -1;
    }
    ::close(out_);
    ::close(err_);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    ending_.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    ending_.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    return ending_;
}

Ending run(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
    return ChildProcess(arguments, surroundings).finish();
}

std::string scene_file(const std::string& name) {
    return (fs::path(VX_SOURCE_DIR) / "scenes" / (name + ".toml")).string();
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

std::string bytes_of(const fs::path& file) {
    std::ostringstream bytes;
    bytes << std::ifstream(file, std::ios::binary).rdbuf();
    return bytes.str();
}

}  // namespace voxilux::test
