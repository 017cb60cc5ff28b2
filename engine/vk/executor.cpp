#include "vk/executor.h"

#include <algorithm>
#include <cstring>

#include "base/checked_cast.h"
#include "vk/barriers.h"
#include "vk/buffer_store.h"
#include "vk/check.h"
#include "vk/command_stream.h"
#include "vk/descriptors.h"
#include "vk/device_state.h"
#include "vk/program_store.h"
#include "vk/timers.h"

namespace voxilux {
namespace {

constexpr int kPoisonByte = 0xCD;
constexpr std::uint32_t kPoisonWord = 0xCDCDCDCDu;

struct StageFlags {
    VkPipelineStageFlags stages = 0;
    VkAccessFlags reads = 0;
    VkAccessFlags writes = 0;
};

StageFlags flags_of(Stage stage) {
    switch (stage) {
        case Stage::compute:
            return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                    VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_UNIFORM_READ_BIT, VK_ACCESS_SHADER_WRITE_BIT};
        case Stage::indirect:
            return {VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, VK_ACCESS_INDIRECT_COMMAND_READ_BIT, 0};
        case Stage::transfer:
            return {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT,
                    VK_ACCESS_TRANSFER_WRITE_BIT};
        case Stage::host:
            return {VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT, 0};
        case Stage::earlier_run:
            return {VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, VK_ACCESS_MEMORY_WRITE_BIT};
    }
    return {};
}

// One barrier for all hazards of a command.
void record_barrier(VkCommandBuffer commands, std::span<const Hazard> hazards) {
    if (hazards.empty()) return;
    StageFlags before;
    StageFlags after;
    for (const Hazard& hazard : hazards) {
        before.stages |= flags_of(hazard.before).stages;
        before.writes |= flags_of(hazard.before).writes;
        after.stages |= flags_of(hazard.after).stages;
        after.reads |= flags_of(hazard.after).reads;
        after.writes |= flags_of(hazard.after).writes;
    }
    const VkMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                  .srcAccessMask = before.writes,
                                  .dstAccessMask = after.reads | after.writes};
    vkCmdPipelineBarrier(commands, before.stages, after.stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace

struct ExecutorState {
    ExecutorState(const DeviceState& opened, std::span<const EmbeddedShader> shaders,
                  const ExecutorOptions& chosen)
        : device(opened),
          options(chosen),
          programs(opened, shaders, chosen.group_size, chosen.cache_dir),
          buffers(opened),
          stream(opened, chosen.staging_bytes) {}

    const DeviceState& device;
    ExecutorOptions options;
    ProgramStore programs;
    BufferStore buffers;
    CommandStream stream;
    Descriptors descriptors;
    Timers timers;
};

namespace {

BarrierContext barrier_context(ExecutorState& state) {
    return {.program = [&](std::string_view shader) -> const ProgramInfo& {
                return state.programs.at(shader).info;
            },
            .is_mapped = [&](std::string_view buffer) { return state.buffers.at(buffer).mapped != nullptr; }};
}

std::vector<PreparedDispatch> prepare_all(ExecutorState& state, const Recording& recording) {
    std::vector<PreparedDispatch> prepared;
    for (const Command& command : recording.commands()) {
        if (const auto* dispatch = std::get_if<Dispatch>(&command))
            prepared.push_back(state.programs.prepare(*dispatch, false));
        if (const auto* indirect = std::get_if<DispatchIndirect>(&command))
            prepared.push_back(state.programs.prepare(indirect->dispatch, true));
    }
    return prepared;
}

// Records the commands of one run into the stream and collects its results.
class RunRecorder {
  public:
    RunRecorder(ExecutorState& state, const Recording& recording)
        : state_(state), dispatches_(prepare_all(state, recording)) {
        state.buffers.acquire(recording);
        const BarrierContext context = barrier_context(state);
        hazards_ = derive_barriers(recording, context);
        for (std::size_t i = 0; i < recording.commands().size(); ++i)
            is_direct_.push_back(is_direct_transfer(recording, i, context));
    }

    RunResult run(const Recording& recording) {
        start_descriptors(state_.device, state_.descriptors, dispatches_);
        state_.stream.begin(staged_bytes(recording));
        const std::size_t timed = state_.options.time_dispatches ? dispatches_.size() : 0;
        start_timers(state_.device, state_.timers, checked_cast<std::uint32_t>(timed, "dispatches"),
                     commands());
        if (state_.options.poison_transients) poison(recording);
        for (std::size_t i = 0; i < recording.commands().size(); ++i)
            record(i, recording.commands()[i]);
        state_.stream.finish();
        for (const Readback* readback : direct_readbacks_)
            copy_out(*readback);
        result_.passes = collect_times(state_.device, state_.timers);
        return std::move(result_);
    }

  private:
    [[nodiscard]] VkCommandBuffer commands() const { return state_.stream.commands(); }

    std::uint64_t staged_bytes(const Recording& recording) const {
        std::uint64_t bytes = 0;
        for (std::size_t i = 0; i < recording.commands().size(); ++i) {
            if (is_direct_[i]) continue;
            if (const auto* upload = std::get_if<Upload>(&recording.commands()[i]))
                bytes += upload->data.size();
            if (const auto* readback = std::get_if<Readback>(&recording.commands()[i]))
                bytes += readback->size_bytes;
        }
        return bytes;
    }

    void record(std::size_t index, const Command& command) {
        const auto first = std::ranges::lower_bound(hazards_, index, {}, &Hazard::command);
        const auto last = std::ranges::upper_bound(hazards_, index, {}, &Hazard::command);
        record_barrier(commands(), std::span(first, last));
        is_direct_now_ = is_direct_[index];
        std::visit([this](const auto& one) { record_one(one); }, command);
    }

    void record_one(const Upload& upload) {
        const Buffer& buffer = state_.buffers.at(upload.buffer);
        if (is_direct_now_) {
            std::memcpy(buffer.mapped + upload.offset_bytes, upload.data.data(), upload.data.size());
        } else {
            state_.stream.upload(buffer, upload.offset_bytes, upload.data);
        }
    }

    void record_one(const Clear& clear) {
        vkCmdFillBuffer(commands(), state_.buffers.at(clear.buffer).handle.get(), 0, VK_WHOLE_SIZE,
                        clear.value);
    }

    void record_one(const Readback& readback) {
        const auto [row, is_new] = result_.readbacks.try_emplace(readback.buffer, readback.size_bytes);
        if (!is_new) {
            throw InternalError(fmt::format("internal error: buffer '{}' is read back twice in one recording",
                                            readback.buffer));
        }
        if (is_direct_now_) {
            direct_readbacks_.push_back(&readback);
        } else {
            state_.stream.readback(state_.buffers.at(readback.buffer), readback.offset_bytes, row->second);
        }
    }

    void record_one(const Dispatch& dispatch) {
        const PreparedDispatch& prepared = bind_next();
        begin_timing(state_.timers, commands(), dispatch.label);
        vkCmdDispatch(commands(), prepared.groups[0], prepared.groups[1], prepared.groups[2]);
        end_timing(state_.timers, commands());
    }

    void record_one(const DispatchIndirect& indirect) {
        bind_next();
        const Buffer& arguments = state_.buffers.at(indirect.arguments);
        begin_timing(state_.timers, commands(), indirect.dispatch.label);
        vkCmdDispatchIndirect(commands(), arguments.handle.get(), indirect.offset_bytes);
        end_timing(state_.timers, commands());
    }

    // The addresses of buffers, then the bytes that came with the dispatch.
    std::vector<std::byte> push_bytes(const PreparedDispatch& prepared) const {
        std::vector<std::byte> bytes;
        for (const AddressMember& member : prepared.program->info.addresses) {
            const auto given = std::ranges::find(prepared.dispatch->addresses, member.name, &Address::member);
            const std::vector<std::byte> address = to_bytes(state_.buffers.at(given->buffer).address);
            bytes.insert(bytes.end(), address.begin(), address.end());
        }
        bytes.insert(bytes.end(), prepared.dispatch->push.begin(), prepared.dispatch->push.end());
        return bytes;
    }

    const PreparedDispatch& bind_next() {
        const PreparedDispatch& prepared = dispatches_[next_dispatch_++];
        const VkPipelineLayout layout = prepared.program->layout.get();
        const VkDescriptorSet set = create_set(state_.device, state_.descriptors, prepared, state_.buffers);
        vkCmdBindPipeline(commands(), VK_PIPELINE_BIND_POINT_COMPUTE, prepared.pipeline);
        vkCmdBindDescriptorSets(commands(), VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
        const std::vector<std::byte> push = push_bytes(prepared);
        if (!push.empty()) {
            vkCmdPushConstants(commands(), layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                               checked_cast<std::uint32_t>(push.size(), "push bytes"), push.data());
        }
        return prepared;
    }

    void copy_out(const Readback& readback) {
        const Buffer& buffer = state_.buffers.at(readback.buffer);
        std::memcpy(result_.readbacks.at(readback.buffer).data(), buffer.mapped + readback.offset_bytes,
                    readback.size_bytes);
    }

    void poison(const Recording& recording) {
        bool is_filled = false;
        for (const BufferProxy& proxy : recording.buffers()) {
            if (proxy.persistent) continue;
            const Buffer& buffer = state_.buffers.at(proxy.name);
            if (buffer.mapped != nullptr) {
                std::memset(buffer.mapped, kPoisonByte, buffer.bytes);
            } else {
                vkCmdFillBuffer(commands(), buffer.handle.get(), 0, VK_WHOLE_SIZE, kPoisonWord);
                is_filled = true;
            }
        }
        if (!is_filled) return;
        const VkMemoryBarrier barrier{
            .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
            .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
            .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT};
        vkCmdPipelineBarrier(commands(), VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                             0, 1, &barrier, 0, nullptr, 0, nullptr);
    }

    ExecutorState& state_;
    std::vector<PreparedDispatch> dispatches_;  // in order of the commands that are dispatches
    std::vector<Hazard> hazards_;
    std::vector<bool> is_direct_;
    std::vector<const Readback*> direct_readbacks_;
    RunResult result_;
    std::size_t next_dispatch_ = 0;
    bool is_direct_now_ = false;
};

std::vector<MemoryRow> with_staging(std::vector<MemoryRow> rows, std::uint64_t staging_bytes) {
    if (staging_bytes > 0) rows.push_back({"executor.staging", staging_bytes});
    return rows;
}

}  // namespace

Executor::Executor(Device& device, std::span<const EmbeddedShader> shaders, ExecutorOptions options)
    : state_(std::make_unique<ExecutorState>(device.state(), shaders, options)) {}
Executor::Executor(Executor&&) noexcept = default;
Executor& Executor::operator=(Executor&&) noexcept = default;
Executor::~Executor() = default;

RunResult Executor::run(const Recording& recording) {
    return RunRecorder(*state_, recording).run(recording);
}

std::vector<MemoryRow> Executor::memory() const {
    return with_staging(state_->buffers.rows(), state_->stream.staging_bytes());
}

std::vector<MemoryRow> Executor::needed_memory() const {
    return with_staging(state_->buffers.declared(), state_->stream.staging_bytes());
}

const Buffer& Executor::buffer(std::string_view name) const {
    return state_->buffers.at(name);
}

std::uint64_t Executor::pipelines_created() const {
    return state_->programs.pipelines_created();
}

}  // namespace voxilux
