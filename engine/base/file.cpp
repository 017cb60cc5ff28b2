#include "base/file.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/error.h"

namespace voxilux {
namespace fs = std::filesystem;

std::vector<std::byte> read_file(const fs::path& path, std::size_t limit_bytes) {
    std::error_code status;
    if (fs::is_directory(path, status))
        throw Error(ExitCode::input_refused, fmt::format("{}: is a folder, not a file", path.string()));
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    if (!in) {
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: cannot open: {}", path.string(), std::strerror(errno)));
    }
    const std::streamoff size = in.tellg();
    if (size < 0) throw Error(ExitCode::input_refused, fmt::format("{}: cannot be sought", path.string()));
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

// The file that a name stands for: what a link points to, so that the link stays a link.
fs::path resolved(const fs::path& path) {
    std::error_code failed;
    const fs::path target = fs::canonical(path, failed);
    return failed ? path : target;
}

// A device or a pipe cannot be replaced by a renamed file, only written to.
bool is_written_in_place(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
}

}  // namespace

void write_file_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    const fs::path target = resolved(path);
    fs::path temporary = target;
    temporary += fmt::format(".{}.tmp", ::getpid());
    try {
        if (is_written_in_place(target)) return write(target);
        write(temporary);
        fs::rename(temporary, target);
    } catch (const std::exception& cause) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
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
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) refuse("it is a folder");
    const bool is_device = fs::exists(file, ignored) && !fs::is_regular_file(file, ignored);
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (!fs::is_directory(folder, ignored)) refuse(fmt::format("there is no folder {}", folder.string()));
    const fs::path& written = is_device ? file : folder;
    if (::access(written.c_str(), W_OK) != 0)
        refuse(fmt::format("{}: {}", written.string(), std::strerror(errno)));
}

}  // namespace voxilux
