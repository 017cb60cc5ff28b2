#include "vk/barriers.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "base/assert.h"

namespace voxilux {
namespace {

constexpr std::size_t index_of(Stage stage) {
    return static_cast<std::size_t>(stage);
}

// How one command touches one buffer.
struct Use {
    std::string buffer;
    Stage stage = Stage::compute;
    bool reads = false;
    bool writes = false;
};

void add_shader_uses(const Dispatch& dispatch, const BarrierContext& context, std::vector<Use>& uses) {
    const ProgramInfo& program = context.program(dispatch.shader);
    for (const Binding& binding : dispatch.bindings) {
        const BufferBlock* block = program.find_block(binding.block);
        if (block == nullptr) continue;
        uses.push_back({binding.buffer, Stage::compute, block->readable, block->writable});
    }
    for (const Address& address : dispatch.addresses) {
        const AddressMember* member = program.find_address(address.member);
        if (member == nullptr) continue;
        uses.push_back({address.buffer, Stage::compute, member->readable, member->writable});
    }
}

struct UsesOf {
    const BarrierContext& context;
    bool direct = false;

    std::vector<Use> operator()(const Upload& upload) const {
        if (direct) return {};
        return {{upload.buffer, Stage::transfer, false, true}};
    }
    std::vector<Use> operator()(const Clear& clear) const {
        return {{clear.buffer, Stage::transfer, false, true}};
    }
    std::vector<Use> operator()(const Dispatch& dispatch) const {
        std::vector<Use> uses;
        add_shader_uses(dispatch, context, uses);
        return uses;
    }
    std::vector<Use> operator()(const DispatchIndirect& indirect) const {
        std::vector<Use> uses{{indirect.arguments, Stage::indirect, true, false}};
        add_shader_uses(indirect.dispatch, context, uses);
        return uses;
    }
    std::vector<Use> operator()(const Readback& readback) const {
        return {{readback.buffer, direct ? Stage::host : Stage::transfer, true, false}};
    }
};

std::vector<Use> uses_of(const Recording& recording, std::size_t command, const BarrierContext& context) {
    return std::visit(UsesOf{context, is_direct_transfer(recording, command, context)},
                      recording.commands()[command]);
}

// What has happened to a buffer since its last write, and which later stages are already ordered after that.
struct BufferState {
    using Ordered = std::array<bool, kStageCount>;

    bool is_written = false;
    Stage writer = Stage::compute;
    Ordered ordered_after_write{};
    std::array<bool, kStageCount> is_read{};                // by stage, since the last write
    std::array<Ordered, kStageCount> ordered_after_read{};  // by reading stage
};

using States = std::map<std::string, BufferState>;

void find_hazards(const Use& use, const BufferState& state, std::size_t command,
                  std::vector<Hazard>& hazards) {
    const auto add = [&](HazardKind kind, Stage before) {
        hazards.push_back({command, use.buffer, kind, before, use.stage});
    };
    bool waits_for_read = false;
    for (std::size_t reader = 0; reader < kStageCount && use.writes; ++reader) {
        if (!state.is_read[reader]) continue;
        waits_for_read = true;
        if (!state.ordered_after_read[reader][index_of(use.stage)])
            add(HazardKind::write_after_read, static_cast<Stage>(reader));
    }
    if (!state.is_written || state.ordered_after_write[index_of(use.stage)]) return;
    if (use.reads) add(HazardKind::read_after_write, state.writer);
    // A read between the two writes was ordered after the first, and this write is ordered after the read.
    if (use.writes && !use.reads && !waits_for_read) add(HazardKind::write_after_write, state.writer);
}

// A barrier between two stages orders every buffer, not only the one that asked for it.
void apply_barrier(const Hazard& hazard, States& states) {
    const std::size_t before = index_of(hazard.before);
    const std::size_t after = index_of(hazard.after);
    for (auto& [name, state] : states) {
        if (state.writer == hazard.before) state.ordered_after_write[after] = true;
        state.ordered_after_read[before][after] = true;
    }
}

void apply_use(const Use& use, States& states) {
    BufferState& state = states[use.buffer];
    if (use.writes) {
        state = {};
        state.is_written = true;
        state.writer = use.stage;
    } else {
        state.is_read[index_of(use.stage)] = true;
        state.ordered_after_read[index_of(use.stage)] = {};
    }
}

States initial_states(const Recording& recording) {
    States states;
    for (const BufferProxy& proxy : recording.buffers()) {
        BufferState state;
        state.is_written = proxy.persistent;
        state.writer = Stage::earlier_run;
        states.emplace(proxy.name, state);
    }
    return states;
}

bool names_buffer(const Command& command, std::string_view buffer) {
    struct Names {
        std::string_view buffer;
        bool operator()(const Upload& upload) const { return upload.buffer == buffer; }
        bool operator()(const Clear& clear) const { return clear.buffer == buffer; }
        bool operator()(const Readback& readback) const { return readback.buffer == buffer; }
        bool operator()(const Dispatch& dispatch) const {
            return std::ranges::count(dispatch.bindings, buffer, &Binding::buffer) > 0 ||
                   std::ranges::count(dispatch.addresses, buffer, &Address::buffer) > 0;
        }
        bool operator()(const DispatchIndirect& indirect) const {
            return indirect.arguments == buffer || (*this)(indirect.dispatch);
        }
    };
    return std::visit(Names{buffer}, command);
}

}  // namespace

bool is_direct_transfer(const Recording& recording, std::size_t command, const BarrierContext& context) {
    const std::span commands(recording.commands());
    const auto is_mapped = [&](const std::string& buffer) {
        return context.is_mapped && context.is_mapped(buffer);
    };
    if (const auto* upload = std::get_if<Upload>(&commands[command])) {
        // The host keeps uploads in order among themselves.
        return is_mapped(upload->buffer) &&
               std::ranges::none_of(commands.first(command), [&](const Command& one) {
                   return !std::holds_alternative<Upload>(one) && names_buffer(one, upload->buffer);
               });
    }
    if (const auto* readback = std::get_if<Readback>(&commands[command])) {
        return is_mapped(readback->buffer) &&
               std::ranges::none_of(commands.subspan(command + 1),
                                    [&](const Command& one) { return names_buffer(one, readback->buffer); });
    }
    return false;
}

std::vector<Hazard> derive_barriers(const Recording& recording, const BarrierContext& context) {
    States states = initial_states(recording);
    std::vector<Hazard> all;
    for (std::size_t command = 0; command < recording.commands().size(); ++command) {
        const std::vector<Use> uses = uses_of(recording, command, context);
        std::vector<Hazard> hazards;
        for (const Use& use : uses)
            find_hazards(use, states[use.buffer], command, hazards);
        for (const Hazard& hazard : hazards)
            apply_barrier(hazard, states);
        for (const Use& use : uses)
            apply_use(use, states);
        all.insert(all.end(), hazards.begin(), hazards.end());
    }
    return all;
}

}  // namespace voxilux
