#include "vk/buffer_store.h"

#include "base/error.h"

namespace voxilux {
namespace {

// For how many runs a transient buffer is kept without being declared: frames that alternate between a few
// recordings do not reallocate, and unused buffers are freed soon.
constexpr std::uint64_t kIdleRuns = 16;

}  // namespace

void BufferStore::acquire(const Recording& recording) {
    ++run_;
    for (const BufferProxy& proxy : recording.buffers()) {
        const auto found = held_.find(proxy.name);
        if (found == held_.end()) continue;
        found->second.last_run = run_;
        if (found->second.buffer.bytes != proxy.size_bytes) held_.erase(found);
    }
    free_idle(kIdleRuns);
    for (const BufferProxy& proxy : recording.buffers()) {
        auto found = held_.find(proxy.name);
        if (found == held_.end()) found = held_.emplace(proxy.name, Held{.buffer = create(proxy)}).first;
        found->second.persistent = proxy.persistent;
        declared_[proxy.name] = found->second.buffer.bytes;
        found->second.last_run = run_;
    }
}

Buffer BufferStore::create(const BufferProxy& proxy) {
    try {
        return create_buffer(*device_, proxy.name, proxy.size_bytes);
    } catch (const Error& error) {
        if (error.code() != ExitCode::out_of_memory) throw;
    }
    free_idle(0);
    return create_buffer(*device_, proxy.name, proxy.size_bytes);
}

void BufferStore::free_idle(std::uint64_t runs) {
    std::erase_if(held_, [&](const auto& entry) {
        return !entry.second.persistent && run_ - entry.second.last_run > runs;
    });
}

const Buffer& BufferStore::at(std::string_view name) const {
    const auto found = held_.find(name);
    if (found == held_.end())
        throw InternalError(fmt::format("internal error: no buffer '{}' is held", name));
    return found->second.buffer;
}

std::vector<MemoryRow> BufferStore::rows() const {
    std::vector<MemoryRow> rows;
    for (const auto& [name, held] : held_)
        rows.push_back({name, held.buffer.bytes});
    return rows;
}

std::vector<MemoryRow> BufferStore::declared() const {
    std::vector<MemoryRow> rows;
    for (const auto& [name, bytes] : declared_)
        rows.push_back({name, bytes});
    return rows;
}

}  // namespace voxilux
