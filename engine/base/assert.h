#pragma once

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <stdexcept>
#include <string_view>

namespace voxilux {

// A defect of the program, not of its input. It ends the process with exit code 70; its message names the
// broken condition.
class InternalError : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

[[noreturn]] inline void assertion_failed(std::string_view condition, std::string_view file, int line,
                                          std::string_view detail) {
    throw InternalError(
        fmt::format("internal error: {} does not hold{} ({}:{})", condition, detail, file, line));
}

}  // namespace voxilux

// Checked in every build, and so never used in inner loops.
#define VX_ASSERT(condition)                                                               \
    do {                                                                                   \
        if (!(condition)) ::voxilux::assertion_failed(#condition, __FILE__, __LINE__, ""); \
    } while (false)

#define VX_ASSERT_EQ(a, b)                                                          \
    do {                                                                            \
        const auto& vx_a = (a);                                                     \
        const auto& vx_b = (b);                                                     \
        if (!(vx_a == vx_b))                                                        \
            ::voxilux::assertion_failed(#a " == " #b, __FILE__, __LINE__,           \
                                        fmt::format(": {} is not {}", vx_a, vx_b)); \
    } while (false)
