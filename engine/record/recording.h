#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/assert.h"

namespace voxilux {

// A named device buffer that does not exist yet. The name is its identity: two proxies of one name are one
// buffer, and the executor gives it that debug name. Persistent buffers keep their contents from one
// recording to the next; the contents of the others are undefined at the start of each recording.
struct BufferProxy {
    std::string name;
    std::uint64_t size_bytes = 0;
    bool persistent = false;

    bool operator==(const BufferProxy&) const = default;
};

// Which proxy a shader's storage block is bound to. The block name is the one written in the shader.
struct Binding {
    std::string block;
    std::string buffer;

    bool operator==(const Binding&) const = default;
};

// Which proxy a pointer in a shader's push struct points to: the way to a buffer that is larger than a
// binding may be. The member's name is the one written in the shader.
struct Address {
    std::string member;
    std::string buffer;

    bool operator==(const Address&) const = default;
};

// Value of a specialization constant by its name in the shader (bool constants take 0 or 1).
struct Constant {
    std::string name;
    std::uint32_t value = 0;

    bool operator==(const Constant&) const = default;
};

// Number of shader invocations, not of workgroups: the executor divides by the reflected local size, rounding
// up. A one-dimensional extent whose groups exceed the device's limit is folded into y; shaders use
// linear_id().
struct Extent {
    std::uint32_t x = 1;
    std::uint32_t y = 1;
    std::uint32_t z = 1;

    bool operator==(const Extent&) const = default;
};

struct Upload {
    std::string buffer;
    std::uint64_t offset_bytes = 0;
    std::vector<std::byte> data;
};

// Fills the whole buffer with one 32-bit word.
struct Clear {
    std::string buffer;
    std::uint32_t value = 0;
};

// One shader over an extent. `label` is "effect.step" and names the timer; push holds the bytes of the push
// struct after its pointers, which come first and are filled in by the executor.
struct Dispatch {
    std::string label;
    std::string shader;
    Extent extent;
    std::vector<Binding> bindings;
    std::vector<Address> addresses;
    std::vector<Constant> constants;
    std::vector<std::byte> push;
};

// A dispatch whose three workgroup counts (uint32 each) are read from a buffer on the device.
struct DispatchIndirect {
    Dispatch dispatch;  // its extent is unused
    std::string arguments;
    std::uint64_t offset_bytes = 0;
};

// Copies the buffer to the host; the executor returns the bytes under the buffer's name.
struct Readback {
    std::string buffer;
    std::uint64_t offset_bytes = 0;
    std::uint64_t size_bytes = 0;
};

using Command = std::variant<Upload, Clear, Dispatch, DispatchIndirect, Readback>;

// A piece of work for the device as plain data: it can be built, printed and tested without one.
class Recording {
  public:
    // Declares a buffer. Declaring the same proxy again is fine; another size under the same name is a defect
    // (asserted).
    void declare(const BufferProxy& proxy);

    void upload(std::string buffer, std::span<const std::byte> data, std::uint64_t offset_bytes = 0);
    void clear(std::string buffer, std::uint32_t value = 0);
    void dispatch(Dispatch dispatch);
    void dispatch_indirect(Dispatch dispatch, std::string arguments, std::uint64_t offset_bytes = 0);
    void readback(std::string buffer);
    void readback(std::string buffer, std::uint64_t offset_bytes, std::uint64_t size_bytes);

    [[nodiscard]] const std::vector<BufferProxy>& buffers() const { return buffers_; }
    [[nodiscard]] const std::vector<Command>& commands() const { return commands_; }

    // Null when the recording declares no buffer of that name.
    [[nodiscard]] const BufferProxy* find(std::string_view name) const;

  private:
    const BufferProxy& require(std::string_view name) const;
    void require_buffers_of(const Dispatch& dispatch) const;

    std::vector<BufferProxy> buffers_;
    std::map<std::string, std::size_t, std::less<>> places_;  // in buffers_, by name
    std::vector<Command> commands_;
};

// Whether the contents of a buffer outlive a recording.
enum class Lifetime : bool { transient, persistent };

// Declares a buffer of `count` elements and returns its name.
template <class T>
std::string declare(Recording& recording, std::string name, std::uint64_t count,
                    Lifetime lifetime = Lifetime::transient) {
    recording.declare(
        {.name = name, .size_bytes = count * sizeof(T), .persistent = lifetime == Lifetime::persistent});
    return name;
}

// One line per buffer and command, stable between runs: what golden tests and `plan -v` show.
[[nodiscard]] std::string describe(const Recording& recording);

// The bytes of a trivially copyable value, for push structs and uploads.
template <class T>
[[nodiscard]] std::vector<std::byte> to_bytes(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<std::byte> bytes(sizeof(T));
    std::memcpy(bytes.data(), &value, sizeof(T));
    return bytes;
}

}  // namespace voxilux
