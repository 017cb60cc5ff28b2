#include "vk/spirv_module.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "base/assert.h"
#include "vk/spirv_numbers.h"

namespace voxilux::spirv {

void fail(std::string_view what) {
    throw InternalError(fmt::format("internal error: bad SPIR-V: {}", what));
}

bool is_descriptor(StorageClass storage) {
    return storage == StorageClass::uniform_constant || storage == StorageClass::uniform ||
           storage == StorageClass::image || storage == StorageClass::storage_buffer;
}

namespace {

// One instruction: its number and its operands, the result included.
struct Instruction {
    std::uint32_t op = 0;
    std::span<const std::uint32_t> operands;

    [[nodiscard]] std::uint32_t at(std::size_t index) const {
        if (index >= operands.size()) fail(fmt::format("instruction {} has too few operands", op));
        return operands[index];
    }
    [[nodiscard]] std::span<const std::uint32_t> from(std::size_t index) const {
        return index <= operands.size() ? operands.subspan(index) : operands.subspan(operands.size());
    }
};

// A literal string starts at operand `index`, four characters a word, and ends with a zero byte.
std::string text_at(const Instruction& instruction, std::size_t index) {
    std::string text;
    for (const std::uint32_t word : instruction.from(index)) {
        for (int byte = 0; byte < 4; ++byte) {
            const char c = std::bit_cast<char>(static_cast<std::uint8_t>(word >> (8 * byte)));
            if (c == '\0') return text;
            text += c;
        }
    }
    fail("a string does not end");
}

void decorate(Module& module, const Instruction& in) {
    Decorations& facts = module.decorations[in.at(0)];
    switch (in.at(1)) {
        case decoration_spec_id:
            facts.spec_id = in.at(2);
            break;
        case decoration_block:
            facts.is_block = true;
            break;
        case decoration_array_stride:
            facts.array_stride = in.at(2);
            break;
        case decoration_built_in:
            facts.is_workgroup_size = facts.is_workgroup_size || in.at(2) == kBuiltInWorkgroupSize;
            break;
        case decoration_non_writable:
            facts.variable.non_writable = true;
            break;
        case decoration_non_readable:
            facts.variable.non_readable = true;
            break;
        case decoration_binding:
            facts.variable.binding = in.at(2);
            break;
        case decoration_descriptor_set:
            facts.variable.set = in.at(2);
            break;
        default:
            break;
    }
}

void decorate_member(Module& module, const Instruction& in) {
    MemberFacts& facts = module.members[{in.at(0), in.at(1)}];
    switch (in.at(2)) {
        case decoration_offset:
            facts.offset = in.at(3);
            break;
        case decoration_matrix_stride:
            facts.matrix_stride = in.at(3);
            break;
        case decoration_non_writable:
            facts.non_writable = true;
            break;
        case decoration_non_readable:
            facts.non_readable = true;
            break;
        default:
            break;
    }
}

void set_execution_mode(Module& module, const Instruction& in) {
    const std::uint32_t mode = in.at(1);
    if (mode != kModeLocalSize && mode != kModeLocalSizeId) return;
    auto& target = mode == kModeLocalSize ? module.local_size : module.local_size_ids;
    target = {in.at(2), in.at(3), in.at(4)};
}

// True when it is an instruction handled here.
bool add_annotation(Module& module, const Instruction& in, int& entry_points) {
    switch (in.op) {
        case op_capability:
            module.capabilities.push_back(in.at(0));
            return true;
        case op_name:
            module.names[in.at(0)] = text_at(in, 1);
            return true;
        case op_member_name:
            module.members[{in.at(0), in.at(1)}].name = text_at(in, 2);
            return true;
        case op_decorate:
            decorate(module, in);
            return true;
        case op_member_decorate:
            decorate_member(module, in);
            return true;
        case op_execution_mode:
        case op_execution_mode_id:
            set_execution_mode(module, in);
            return true;
        case op_entry_point:
            if (in.at(0) != kModelGlCompute) fail("the entry point is not a compute shader");
            ++entry_points;
            return true;
        default:
            return false;
    }
}

bool add_type(Module& module, const Instruction& in) {
    const auto add = [&](Type type) {
        module.types[in.at(0)] = std::move(type);
        return true;
    };
    switch (in.op) {
        case op_type_bool:
            return add({.kind = Type::scalar, .width_bits = 32});
        case op_type_int:
        case op_type_float:
            return add({.kind = Type::scalar, .width_bits = in.at(1)});
        case op_type_vector:
            return add({.kind = Type::vector, .element = in.at(1), .count = in.at(2)});
        case op_type_matrix:
            return add({.kind = Type::matrix, .element = in.at(1), .count = in.at(2)});
        case op_type_image:  // only storage texel buffers of four words a texel or of one
            if (in.at(2) != kDimBuffer || in.at(6) != kImageIsStorage) return false;
            if (in.at(7) == kFormatRgba32ui) return add({.kind = Type::texels, .count = 4});
            return in.at(7) == kFormatR32ui && add({.kind = Type::texels, .count = 1});
        case op_type_array:
            return add({.kind = Type::array, .element = in.at(1), .count = in.at(2)});
        case op_type_runtime_array:
            return add({.kind = Type::runtime_array, .element = in.at(1)});
        case op_type_pointer:
            return add(
                {.kind = Type::pointer, .element = in.at(2), .storage = static_cast<StorageClass>(in.at(1))});
        case op_type_struct: {
            const auto members = in.from(1);
            return add({.kind = Type::structure, .members = {members.begin(), members.end()}});
        }
        default:
            return false;
    }
}

bool add_value(Module& module, const Instruction& in) {
    switch (in.op) {
        case op_constant_true:
        case op_spec_constant_true:
            module.constants[in.at(1)].value = 1;
            return true;
        case op_constant_false:
        case op_spec_constant_false:
            module.constants[in.at(1)].value = 0;
            return true;
        case op_constant:
        case op_spec_constant: {
            const bool is_one_word = in.operands.size() == 3;
            module.constants[in.at(1)].value = is_one_word ? std::optional(in.at(2)) : std::nullopt;
            return true;
        }
        case op_constant_composite:
        case op_spec_constant_composite: {
            const auto parts = in.from(2);
            module.composites[in.at(1)] = {parts.begin(), parts.end()};
            return true;
        }
        case op_variable:
            module.variables[in.at(1)] = {.type = in.at(0), .storage = static_cast<StorageClass>(in.at(2))};
            return true;
        default:
            return false;
    }
}

// The ids through which an instruction accesses memory.
std::span<const std::uint32_t> touched_ids(const Instruction& in) {
    switch (in.op) {
        case op_store:
            return in.from(0).first(std::min<std::size_t>(1, in.operands.size()));
        case op_copy_memory:
            return in.from(0);
        case op_load:
        case op_access_chain:
        case op_in_bounds_access_chain:
        case op_ptr_access_chain:
        case op_in_bounds_ptr_access_chain:
        case op_array_length:
            return in.from(2).first(std::min<std::size_t>(1, in.from(2).size()));
        case op_function_call:
            return in.from(3);
        default:
            return {};
    }
}

void note_use(Module& module, const Instruction& in) {
    for (const std::uint32_t id : touched_ids(in)) {
        if (module.variables.contains(id)) module.used_variables.insert(id);
    }
}

// A constant decorated as the workgroup size overrides the execution mode (specification, 3.21 BuiltIn).
void apply_workgroup_size(Module& module) {
    for (const auto& [id, facts] : module.decorations) {
        const auto parts = module.composites.find(id);
        if (!facts.is_workgroup_size || parts == module.composites.end()) continue;
        if (parts->second.size() != 3) fail("the workgroup size is not three constants");
        std::ranges::copy(parts->second, module.local_size_ids.begin());
    }
}

}  // namespace

Module parse(std::span<const std::uint32_t> words) {
    if (words.size() < kHeaderWords || words[0] != kMagic) fail("no SPIR-V header");
    Module module;
    int entry_points = 0;
    for (std::size_t at = kHeaderWords; at < words.size();) {
        const std::size_t count = words[at] >> 16;
        if (count == 0 || count > words.size() - at)
            fail(fmt::format("word {}: an instruction overruns", at));
        const Instruction in{.op = words[at] & 0xFFFFu, .operands = words.subspan(at + 1, count - 1)};
        if (!add_annotation(module, in, entry_points) && !add_type(module, in) && !add_value(module, in))
            note_use(module, in);
        at += count;
    }
    if (entry_points != 1) fail("there is not exactly one entry point");
    apply_workgroup_size(module);
    return module;
}

const Type& Module::type(std::uint32_t id) const {
    const auto found = types.find(id);
    if (found != types.end()) return found->second;
    static const Type unknown;
    return unknown;
}

std::uint32_t Module::constant(std::uint32_t id) const {
    const auto found = constants.find(id);
    if (found == constants.end() || !found->second.value)
        fail(fmt::format("%{} is not a 32-bit constant", id));
    return *found->second.value;
}

std::string Module::name(std::uint32_t id) const {
    const auto found = names.find(id);
    return found == names.end() ? std::string() : found->second;
}

MemberFacts Module::member(std::uint32_t struct_id, std::uint32_t index) const {
    const auto found = members.find({struct_id, index});
    return found == members.end() ? MemberFacts() : found->second;
}

VariableFacts Module::variable_facts(std::uint32_t id) const {
    const auto found = decorations.find(id);
    return found == decorations.end() ? VariableFacts() : found->second.variable;
}

bool Module::is_block(std::uint32_t id) const {
    const auto found = decorations.find(id);
    return found != decorations.end() && found->second.is_block;
}

std::uint32_t Module::array_stride(std::uint32_t id) const {
    const auto found = decorations.find(id);
    return found == decorations.end() ? 0 : found->second.array_stride;
}

std::optional<std::uint32_t> Module::spec_id(std::uint32_t id) const {
    const auto found = decorations.find(id);
    return found == decorations.end() ? std::nullopt : found->second.spec_id;
}

}  // namespace voxilux::spirv
