#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxilux {

// The whole file. Throws Error(input_refused) when it is absent, unreadable or over `limit_bytes`.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& path,
                                               std::size_t limit_bytes = std::size_t{8} << 30);

// Calls `write` with a temporary name in the folder of `path`, flushes that file to the disk and renames it
// onto `path`: after a failure, a kill or a power cut, a reader sees the old file or the whole new one. The
// temporary file is created under a name that nobody can guess, so that nobody can plant a link there. A link
// at `path` stays a link, the mode of the old file is kept, and a device or a pipe is written to directly.
// Throws Error(cannot_write) and leaves nothing behind.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path& temporary)>& write);

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

// Whether the file name ends in `ending` (".exr"), in lower or upper case.
[[nodiscard]] bool has_ending(const std::filesystem::path& file, std::string_view ending);

// Throws Error(cannot_write) for a file that could not be written later: the name is that of a folder or too
// long, or the file's folder is absent or not writable. Accepts "" and "-". Called before the work, so that
// no work is lost.
void check_writable(const std::filesystem::path& file);

// check_writable for each output. Throws Error(usage) for one that would replace an input or another output,
// whatever name it goes by. Also removes temporary files that killed processes have left in the folders of
// the outputs.
void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

}  // namespace voxilux
