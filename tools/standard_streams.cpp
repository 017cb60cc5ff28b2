#include "standard_streams.h"

#include <cstdio>

#include <fmt/format.h>

#include "base/error.h"

namespace voxilux {

std::vector<std::byte> read_standard_input(std::size_t limit_bytes) {
    constexpr std::size_t kPart = std::size_t{1} << 16;
    std::vector<std::byte> bytes;
    while (true) {
        const std::size_t known = bytes.size();
        bytes.resize(known + kPart);
        const std::size_t read = std::fread(bytes.data() + known, 1, kPart, stdin);
        bytes.resize(known + read);
        if (bytes.size() > limit_bytes)
            throw Error(ExitCode::input_refused,
                        fmt::format("standard input: over the limit of {} bytes", limit_bytes));
        if (read == kPart) continue;
        if (std::ferror(stdin) != 0) throw Error(ExitCode::input_refused, "standard input: cannot be read");
        return bytes;
    }
}

void write_standard_output(std::span<const std::byte> bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
        throw Error(ExitCode::cannot_write, "cannot write to standard output");
}

}  // namespace voxilux
