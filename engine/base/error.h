#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "base/assert.h"

namespace voxilux {

// Process exit codes. Scripts rely on them: a number never changes its meaning.
enum class ExitCode : int {
    done = 0,
    usage = 2,
    input_refused = 3,
    time_limit = 4,
    over_threshold = 5,
    no_device = 69,
    internal = 70,
    device_lost = 71,
    cannot_write = 73,
    out_of_memory = 74,
    temporary = 75,
    interrupted = 130,
};

// A failure outside the program (device, file, memory): one line that says what failed, with which input, and
// what to try. The code becomes the exit code of the process when nobody handles the error.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    [[nodiscard]] ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

// Why an expected outcome (a bad file, an unsupported device) did not give a value.
struct Failure {
    std::string reason;
};

// A value, or the reason why there is none. For outcomes that a caller must expect; see Error for the rest.
template <class T>
class Result {
  public:
    Result(T value) : state_(std::move(value)) {}
    Result(Failure failure) : state_(std::move(failure)) {}

    [[nodiscard]] bool ok() const { return std::holds_alternative<T>(state_); }
    explicit operator bool() const { return ok(); }

    [[nodiscard]] const T& value() const& { return checked(); }
    [[nodiscard]] T&& value() && {
        VX_ASSERT(ok());
        return std::get<T>(std::move(state_));
    }
    [[nodiscard]] const std::string& reason() const {
        VX_ASSERT(!ok());
        return std::get<Failure>(state_).reason;
    }

    // The value, or an Error with `code` and the reason.
    [[nodiscard]] T value_or_throw(ExitCode code) && {
        if (!ok()) throw Error(code, reason());
        return std::get<T>(std::move(state_));
    }

  private:
    const T& checked() const {
        VX_ASSERT(ok());
        return std::get<T>(state_);
    }

    std::variant<T, Failure> state_;
};

}  // namespace voxilux
