#include "base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>
#include <set>
#include <string_view>
#include <system_error>

#include "base/error.h"

namespace voxilux {
namespace fs = std::filesystem;

std::vector<std::byte> read_file(const fs::path& path, std::size_t limit_bytes) {
    std::error_code status;
    if (fs::is_directory(path, status))
        throw Error(ExitCode::input_refused, fmt::format("{}: is a folder, not a file", path.string()));
    if (fs::is_fifo(path, status))
        throw Error(
            ExitCode::input_refused,
            fmt::format("{}: is a pipe, which is not seekable: save it as a file first", path.string()));
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    if (!in) {
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: cannot open: {}", path.string(), std::strerror(errno)));
    }
    const std::streamoff size = in.tellg();
    if (size < 0) throw Error(ExitCode::input_refused, fmt::format("{}: is not seekable", path.string()));
    if (static_cast<std::size_t>(size) > limit_bytes) {
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: {} bytes, over the limit of {}", path.string(), size, limit_bytes));
    }
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    in.seekg(0);
    in.read(reinterpret_cast<char*>(bytes.data()), size);
    if (!in) throw Error(ExitCode::input_refused, fmt::format("{}: read stopped early", path.string()));
    return bytes;
}

namespace {

constexpr int kMaxLinks = 40;  // as many as the kernel follows
constexpr std::string_view kTemporaryPrefix = ".voxilux-", kTemporaryEnding = ".tmp";
constexpr auto kStaleAfter = std::chrono::hours(1);

// The file that a name stands for: the end of its chain of links, whether it exists or not. Replacing that
// file leaves the links in place.
fs::path resolved(fs::path path) {
    std::error_code failed;
    for (int links = 0; links < kMaxLinks && fs::is_symlink(path, failed); ++links) {
        const fs::path target = fs::read_symlink(path, failed);
        if (failed) break;
        path = path.parent_path() / target;  // an absolute target replaces the folder
    }
    return path;
}

// A device or a pipe cannot be replaced by a renamed file, only written to.
bool is_written_in_place(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
}

[[noreturn]] void throw_errno() {
    throw std::runtime_error(std::strerror(errno));
}

// A new, empty file beside `target`, with its mode. The destructor removes it unless it was renamed.
class TemporaryFile {
  public:
    explicit TemporaryFile(const fs::path& target) {
        std::random_device random;
        const std::uint64_t name = std::uint64_t{random()} << 32 | random();
        path_ = target.parent_path() /
                fmt::format("{}{}-{:016x}{}", kTemporaryPrefix, ::getpid(), name, kTemporaryEnding);
        struct stat old {};
        const bool is_there = ::stat(target.c_str(), &old) == 0;
        const int file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file < 0) throw_errno();
        if (is_there) (void)::fchmod(file, old.st_mode & 07777);
        ::close(file);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() { (void)::unlink(path_.c_str()); }

    [[nodiscard]] const fs::path& path() const { return path_; }
    void rename_to(const fs::path& target) const {
        sync(path_, O_RDONLY);
        if (::rename(path_.c_str(), target.c_str()) != 0) throw_errno();
        try {  // the file is complete; some file systems cannot sync a folder
            sync(target.has_parent_path() ? target.parent_path() : ".", O_RDONLY | O_DIRECTORY);
        } catch (const std::runtime_error&) {
        }
    }

  private:
    static void sync(const fs::path& path, int flags) {
        const int file = ::open(path.c_str(), flags | O_CLOEXEC);
        if (file < 0) throw_errno();
        const int failure = ::fsync(file) == 0 ? 0 : errno;
        ::close(file);
        errno = failure;
        if (failure != 0) throw_errno();
    }

    fs::path path_;
};

// Removes what killed processes have left: their process is gone, and the file has not changed for an hour
// (the folder may be shared with other machines).
void remove_stale_temporaries(const fs::path& folder) {
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
        const std::string name = entry.path().filename().string();
        int process = 0;
        if (!name.starts_with(kTemporaryPrefix) || !name.ends_with(kTemporaryEnding)) continue;
        if (std::sscanf(name.c_str() + kTemporaryPrefix.size(), "%d", &process) != 1 || process <= 0)
            continue;
        if (::kill(process, 0) == 0 || errno != ESRCH) continue;
        const auto written = entry.last_write_time(failed);
        if (!failed && fs::file_time_type::clock::now() - written > kStaleAfter)
            fs::remove(entry.path(), failed);
    }
}

}  // namespace

void write_file_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    try {
        const fs::path target = resolved(path);
        if (fs::is_symlink(target)) throw std::runtime_error(std::strerror(ELOOP));
        if (is_written_in_place(target)) return write(target);
        const TemporaryFile temporary(target);
        write(temporary.path());
        temporary.rename_to(target);
    } catch (const std::exception& cause) {
        throw Error(ExitCode::cannot_write, fmt::format("{}: cannot write: {}", path.string(), cause.what()));
    }
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
    write_file_atomically(path, [&](const fs::path& temporary) {
        errno = 0;
        std::ofstream out(temporary, std::ios::binary);
        out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        out.close();
        if (!out) throw std::runtime_error(std::strerror(errno != 0 ? errno : EIO));
    });
}

bool has_ending(const fs::path& file, std::string_view ending) {
    std::string own = file.extension().string();
    std::ranges::transform(own, own.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return own == ending;
}

void check_writable(const fs::path& file) {
    if (file.empty() || file == "-") return;
    const auto refuse = [&](const std::string& why) {
        throw Error(ExitCode::cannot_write, fmt::format("{}: cannot write: {}", file.string(), why));
    };
    struct stat found {};
    if (::stat(file.c_str(), &found) != 0 && (errno == ENAMETOOLONG || errno == ELOOP))
        refuse(std::strerror(errno));
    const fs::path target = resolved(file);
    std::error_code ignored;
    if (fs::is_directory(target, ignored)) refuse("it is a folder");
    const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
    if (!fs::is_directory(folder, ignored)) refuse(fmt::format("there is no folder {}", folder.string()));
    const fs::path& written = is_written_in_place(target) ? target : folder;
    if (::access(written.c_str(), W_OK) != 0)
        refuse(fmt::format("{}: {}", written.string(), std::strerror(errno)));
}

void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
    const auto place = [](const std::string& name) {
        std::error_code failed;
        const fs::path known = fs::weakly_canonical(fs::absolute(resolved(name)), failed);
        return failed ? fs::path(name) : known;
    };
    std::set<fs::path> read, written, folders;
    for (const std::string& input : inputs) {
        if (!input.empty()) read.insert(place(input));
    }
    for (const std::string& output : outputs) {
        check_writable(output);
        const bool is_file = !output.empty() && output != "-" && !is_written_in_place(resolved(output));
        if (!is_file) continue;
        const fs::path target = place(output);
        if (read.contains(target))
            throw Error(ExitCode::usage, fmt::format("{}: is an input; write to another file", output));
        if (!written.insert(target).second)
            throw Error(ExitCode::usage,
                        fmt::format("{}: is written twice; give each output a name", output));
        folders.insert(target.parent_path());
    }
    for (const fs::path& folder : folders)
        remove_stale_temporaries(folder);
}

}  // namespace voxilux
