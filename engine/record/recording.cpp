#include "record/recording.h"

#include <utility>

namespace voxilux {

void Recording::declare(const BufferProxy& proxy) {
    VX_ASSERT(!proxy.name.empty());
    VX_ASSERT(proxy.size_bytes > 0);
    if (const BufferProxy* known = find(proxy.name)) {
        VX_ASSERT_EQ(known->size_bytes, proxy.size_bytes);
        VX_ASSERT_EQ(known->persistent, proxy.persistent);
        return;
    }
    places_.emplace(proxy.name, buffers_.size());
    buffers_.push_back(proxy);
}

const BufferProxy* Recording::find(std::string_view name) const {
    const auto found = places_.find(name);
    return found == places_.end() ? nullptr : &buffers_[found->second];
}

const BufferProxy& Recording::require(std::string_view name) const {
    const BufferProxy* proxy = find(name);
    if (proxy == nullptr)
        throw InternalError(fmt::format("internal error: buffer '{}' is used but not declared", name));
    return *proxy;
}

void Recording::upload(std::string buffer, std::span<const std::byte> data, std::uint64_t offset_bytes) {
    VX_ASSERT(offset_bytes + data.size() <= require(buffer).size_bytes);
    VX_ASSERT_EQ(offset_bytes % 4, 0u);
    VX_ASSERT_EQ(data.size() % 4, 0u);
    if (data.empty()) return;
    commands_.push_back(Upload{std::move(buffer), offset_bytes, {data.begin(), data.end()}});
}

void Recording::clear(std::string buffer, std::uint32_t value) {
    require(buffer);
    commands_.push_back(Clear{std::move(buffer), value});
}

void Recording::require_buffers_of(const Dispatch& dispatch) const {
    for (const Binding& binding : dispatch.bindings)
        require(binding.buffer);
    for (const Address& address : dispatch.addresses)
        require(address.buffer);
}

void Recording::dispatch(Dispatch dispatch) {
    require_buffers_of(dispatch);
    const bool empty = dispatch.extent.x == 0 || dispatch.extent.y == 0 || dispatch.extent.z == 0;
    if (!empty) commands_.push_back(std::move(dispatch));
}

void Recording::dispatch_indirect(Dispatch dispatch, std::string arguments, std::uint64_t offset_bytes) {
    require_buffers_of(dispatch);
    VX_ASSERT(offset_bytes + 12 <= require(arguments).size_bytes);
    commands_.push_back(DispatchIndirect{std::move(dispatch), std::move(arguments), offset_bytes});
}

void Recording::readback(std::string buffer) {
    const std::uint64_t size_bytes = require(buffer).size_bytes;
    readback(std::move(buffer), 0, size_bytes);
}

void Recording::readback(std::string buffer, std::uint64_t offset_bytes, std::uint64_t size_bytes) {
    VX_ASSERT(offset_bytes + size_bytes <= require(buffer).size_bytes);
    commands_.push_back(Readback{std::move(buffer), offset_bytes, size_bytes});
}

namespace {

std::string describe_dispatch(const Dispatch& dispatch) {
    std::string text = fmt::format("{} [{}]", dispatch.label, dispatch.shader);
    for (const Constant& constant : dispatch.constants)
        text += fmt::format(" {}={}", constant.name, constant.value);
    for (const Binding& binding : dispatch.bindings)
        text += fmt::format(" {}<-{}", binding.block, binding.buffer);
    for (const Address& address : dispatch.addresses)
        text += fmt::format(" {}<-&{}", address.member, address.buffer);
    return text;
}

struct DescribeCommand {
    std::string operator()(const Upload& upload) const {
        return fmt::format("upload   {} {} bytes at {}", upload.buffer, upload.data.size(),
                           upload.offset_bytes);
    }
    std::string operator()(const Clear& clear) const {
        return fmt::format("clear    {} to {}", clear.buffer, clear.value);
    }
    std::string operator()(const Dispatch& dispatch) const {
        return fmt::format("dispatch {}x{}x{} {}", dispatch.extent.x, dispatch.extent.y, dispatch.extent.z,
                           describe_dispatch(dispatch));
    }
    std::string operator()(const DispatchIndirect& indirect) const {
        return fmt::format("dispatch from {}+{} {}", indirect.arguments, indirect.offset_bytes,
                           describe_dispatch(indirect.dispatch));
    }
    std::string operator()(const Readback& readback) const {
        return fmt::format("readback {} {} bytes at {}", readback.buffer, readback.size_bytes,
                           readback.offset_bytes);
    }
};

}  // namespace

std::string describe(const Recording& recording) {
    std::string text;
    for (const BufferProxy& proxy : recording.buffers()) {
        text += fmt::format("buffer   {} {} bytes{}\n", proxy.name, proxy.size_bytes,
                            proxy.persistent ? " persistent" : "");
    }
    for (const Command& command : recording.commands())
        text += std::visit(DescribeCommand{}, command) + "\n";
    return text;
}

}  // namespace voxilux
