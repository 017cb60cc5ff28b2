#pragma once

// The built binary as a user runs it: arguments and environment in, code, output and files out.

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace voxilux::test {

struct Surroundings {
    std::filesystem::path folder;                    // current folder; empty: that of the test
    std::map<std::string, std::string> environment;  // set on top of the test's own
    std::filesystem::path output_file;               // where standard output goes; empty: a pipe that is read
    std::filesystem::path error_file;                // likewise of standard error
    std::vector<int> ignored_signals;
    std::uint64_t largest_file = 0;   // bytes a written file may have, as on a full disk; 0: no limit
    std::uint64_t address_space = 0;  // bytes, as of ulimit -v; 0: no limit
};

struct Ending {
    int code = -1;   // exit code, or -1 when a signal ended it
    int signal = 0;  // the signal that ended it, or 0
    std::string out;
    std::string err;
};

// A running voxilux. Its environment has folders of the tests' own for caches and for what it remembers.
class ChildProcess {
  public:
    explicit ChildProcess(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    ~ChildProcess();  // kills it if it still runs

    // Waits until standard error holds a whole line, and returns it; empty when the process ended without
    // one.
    std::string wait_for_error_line();

    // Waits until standard error holds `text`; false when the process ended without it.
    [[nodiscard]] bool wait_for_error(const std::string& text);

    void send(int signal);

    // Waits for the end.
    Ending finish();

  private:
    pid_t pid_ = -1;
    int out_ = -1;
    int err_ = -1;
    Ending ending_;
};

// Runs voxilux to its end.
[[nodiscard]] Ending run(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});

// A scene file of this repository.
[[nodiscard]] std::string scene_file(const std::string& name);

// Names in a folder, sorted: what a command left behind.
[[nodiscard]] std::vector<std::string> names_in(const std::filesystem::path& folder);

[[nodiscard]] std::string bytes_of(const std::filesystem::path& file);

}  // namespace voxilux::test
