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
// onto `path`: after a failure, a kill or a power cut a reader sees the old file or the whole new one. The
// temporary file is made anew under a name that nobody can guess, so that no link of somebody else is
// followed. A link that stands at `path` stays a link, the mode of the old file stays, and a device or a pipe
// is written to directly. Throws Error(cannot_write), and then leaves nothing behind.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path& temporary)>& write);

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

// Whether the file's ending is `ending` (".exr") in small or capital letters.
[[nodiscard]] bool has_ending(const std::filesystem::path& file, std::string_view ending);

// Throws Error(cannot_write) for a file that could not be written later: a folder of that name, a folder that
// is absent or may not be written into, a name that is too long. Nothing for "" and "-". Finding out before
// the work is kinder than after it.
void check_writable(const std::filesystem::path& file);

// check_writable for each output. Throws Error(usage) for one that would replace an input or another output,
// under whatever name. Removes temporary files that killed processes have left in their folders.
void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

}  // namespace voxilux
