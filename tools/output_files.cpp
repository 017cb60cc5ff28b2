#include "output_files.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <span>

#include "base/error.h"
#include "base/file.h"

namespace voxilux {
namespace fs = std::filesystem;

bool has_ending(const fs::path& file, std::string_view ending) {
    std::string own = file.extension().string();
    std::ranges::transform(own, own.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return own == ending;
}

fs::path numbered(const fs::path& file, std::int64_t frame, std::int64_t last) {
    const std::size_t digits = std::max<std::size_t>(4, std::to_string(last).size());
    fs::path name = file.stem();
    name += fmt::format(".{:0{}}", frame, digits);
    name += file.extension();
    return file.parent_path() / name;
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

void write_json(const std::string& file, const nlohmann::ordered_json& json) {
    if (file.empty()) return;
    const std::string text = json.dump(2) + "\n";
    if (file == "-")
        fmt::print("{}", text);
    else
        write_file_atomically(file, std::as_bytes(std::span(text)));
}

}  // namespace voxilux
