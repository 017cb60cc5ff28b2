#include "base/build_id.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/error.h"
#include "base/file.h"
#include "base/fnv.h"

namespace voxilux {
namespace {

std::string hash_of_program() try {
    const std::vector<std::byte> bytes = read_file("/proc/self/exe");
    std::uint64_t hash = kFnvStart;
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::uint64_t)) {
        std::uint64_t unit = 0;
        std::memcpy(&unit, bytes.data() + at, std::min(sizeof unit, bytes.size() - at));
        hash = fnv1a(hash, unit);
    }
    return fmt::format("{:016x}", fnv1a(hash, bytes.size()));
} catch (const Error&) {
    return "unknown";
}

}  // namespace

const std::string& build_id() {
    static const std::string id = hash_of_program();
    return id;
}

}  // namespace voxilux
