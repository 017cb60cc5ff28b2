#include "vk/spirv_reflect.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/assert.h"
#include "vk/spirv_module.h"

namespace voxilux {
namespace {

// The deepest nesting of types that is followed: a broken module may nest a type in itself.
constexpr int kMaxTypeDepth = 32;

using spirv::Module;
using spirv::Type;

std::uint32_t end_of_struct(const Module& module, std::uint32_t type_id, int depth);

// Bytes that one value of the type covers in memory; 0 for arrays without a length.
std::uint32_t size_of_type(const Module& module, std::uint32_t type_id, std::uint32_t matrix_stride,
                           int depth) {
    if (depth > kMaxTypeDepth) spirv::fail("types nest too deep");
    const Type& type = module.type(type_id);
    switch (type.kind) {
        case Type::scalar:
            return type.width_bits / 8;
        case Type::vector:
            return type.count * size_of_type(module, type.element, 0, depth + 1);
        case Type::matrix:
            return type.count * matrix_stride;
        case Type::array:
            return module.constant(type.count) * module.array_stride(type_id);
        case Type::structure:
            return end_of_struct(module, type_id, depth + 1);
        case Type::pointer:
            return kAddressBytes;
        case Type::runtime_array:
        case Type::texels:
        case Type::other:
            return 0;
    }
    return 0;
}

std::uint32_t end_of_struct(const Module& module, std::uint32_t type_id, int depth) {
    const Type& type = module.type(type_id);
    std::uint32_t end = 0;
    for (std::uint32_t i = 0; i < type.members.size(); ++i) {
        const spirv::MemberFacts facts = module.member(type_id, i);
        const std::uint32_t bytes = size_of_type(module, type.members[i], facts.matrix_stride, depth);
        end = std::max(end, facts.offset.value_or(0) + bytes);
    }
    return end;
}

std::vector<StructMember> members_of(const Module& module, std::uint32_t type_id) {
    std::vector<StructMember> members;
    const Type& type = module.type(type_id);
    for (std::uint32_t i = 0; i < type.members.size(); ++i) {
        const spirv::MemberFacts facts = module.member(type_id, i);
        members.push_back({.name = facts.name, .offset = facts.offset.value_or(0)});
    }
    return members;
}

bool has_layout(const Module& module, std::uint32_t type_id) {
    const Type& type = module.type(type_id);
    for (std::uint32_t i = 0; i < type.members.size(); ++i) {
        if (!module.member(type_id, i).offset) return false;
    }
    return type.kind == Type::structure && !type.members.empty();
}

std::uint32_t stride_of_arrays_of(const Module& module, std::uint32_t struct_id) {
    for (const auto& [id, type] : module.types) {
        const bool is_array = type.kind == Type::array || type.kind == Type::runtime_array;
        if (is_array && type.element == struct_id) return module.array_stride(id);
    }
    return 0;
}

std::vector<StructInfo> structs_of(const Module& module) {
    std::vector<StructInfo> structs;
    for (const auto& [id, type] : module.types) {
        if (!has_layout(module, id)) continue;
        const bool open = module.type(type.members.back()).kind == Type::runtime_array;
        structs.push_back({.name = module.name(id),
                           .members = members_of(module, id),
                           .size_bytes = open ? 0 : end_of_struct(module, id, 0),
                           .array_stride = stride_of_arrays_of(module, id)});
    }
    return structs;
}

// The struct a variable points to.
std::uint32_t pointee(const Module& module, const spirv::Variable& variable) {
    const Type& pointer = module.type(variable.type);
    if (pointer.kind != Type::pointer) spirv::fail("a variable's type is not a pointer");
    return pointer.element;
}

struct Access {
    bool readable = true;
    bool writable = true;
};

// The access that the decorations of a block's members allow: it is readonly or writeonly when all of them
// are.
Access access_of(const Module& module, std::uint32_t struct_id) {
    const std::size_t count = module.type(struct_id).members.size();
    Access access{.readable = count == 0, .writable = count == 0};
    for (std::uint32_t i = 0; i < count; ++i) {
        const spirv::MemberFacts member = module.member(struct_id, i);
        access.readable = access.readable || !member.non_readable;
        access.writable = access.writable || !member.non_writable;
    }
    return access;
}

BufferBlock block_of(const Module& module, std::uint32_t variable_id, const spirv::Variable& variable) {
    const std::uint32_t struct_id = pointee(module, variable);
    const Type& type = module.type(struct_id);
    if (type.kind != Type::structure) spirv::fail("a buffer is not a block (an array of blocks?)");
    const spirv::VariableFacts facts = module.variable_facts(variable_id);
    const Access access = access_of(module, struct_id);
    if (!facts.binding) spirv::fail("a buffer has no binding");
    BufferBlock block{.name = module.name(struct_id),
                      .set = facts.set.value_or(0),
                      .binding = *facts.binding,
                      .readable = !facts.non_readable && access.readable,
                      .writable = !facts.non_writable && access.writable};
    if (variable.storage == spirv::StorageClass::uniform) {
        if (!module.is_block(struct_id))
            spirv::fail("a uniform block is not one (a storage buffer of SPIR-V 1.2?)");
        block.kind = BlockKind::uniform;
        block.writable = false;
    }
    if (block.name.empty()) spirv::fail("a block has no name");
    return block;
}

// A storage texel buffer, by the name of its variable.
BufferBlock texels_of(const Module& module, std::uint32_t variable_id, const spirv::Variable& variable) {
    const Type& type = module.type(pointee(module, variable));
    if (type.kind != Type::texels) spirv::fail("a resource is not a buffer");
    const spirv::VariableFacts facts = module.variable_facts(variable_id);
    if (!facts.binding) spirv::fail("a buffer has no binding");
    return {.name = module.name(variable_id),
            .set = facts.set.value_or(0),
            .binding = *facts.binding,
            .readable = !facts.non_readable,
            .writable = !facts.non_writable,
            .kind = type.count == 1 ? BlockKind::words : BlockKind::texels};
}

void check_blocks(const std::vector<BufferBlock>& blocks) {
    std::set<std::string> names;
    std::set<std::uint32_t> bindings;
    for (const BufferBlock& block : blocks) {
        if (block.set != 0) spirv::fail("a block is not in set 0");
        if (!names.insert(block.name).second) spirv::fail("two blocks share a name");
        if (!bindings.insert(block.binding).second) spirv::fail("two blocks share a binding");
    }
}

bool is_address(const Type& type) {
    return type.kind == Type::pointer && type.storage == spirv::StorageClass::physical_storage_buffer;
}

void add_addresses(const Module& module, std::uint32_t struct_id, ProgramInfo& info) {
    const Type& type = module.type(struct_id);
    for (std::uint32_t i = 0; i < type.members.size(); ++i) {
        const Type& member = module.type(type.members[i]);
        if (!is_address(member)) continue;
        const spirv::MemberFacts facts = module.member(struct_id, i);
        if (facts.offset != info.addresses.size() * kAddressBytes)
            spirv::fail("the pointers of the push struct are not its first members");
        const Access access = access_of(module, member.element);
        info.addresses.push_back({facts.name, access.readable, access.writable});
    }
}

// Barriers are derived from the pointers of the push struct, so no other pointer may lead to a block: none
// stored in buffers, none made from integers.
void check_pointers(const Module& module) {
    std::set<std::uint32_t> known;
    for (const auto& [id, variable] : module.variables) {
        if (variable.storage != spirv::StorageClass::push_constant) continue;
        const Type& type = module.type(pointee(module, variable));
        known.insert(type.members.begin(), type.members.end());
    }
    for (const auto& [id, type] : module.types) {
        if (is_address(type) && module.is_block(type.element) && !known.contains(id))
            spirv::fail("a pointer to a block is not a member of the push struct");
    }
}

void add_variables(const Module& module, ProgramInfo& info) {
    for (const auto& [id, variable] : module.variables) {
        // Blocks that are declared but not used have no binding of their own and need no buffer.
        if (!module.used_variables.contains(id)) continue;
        if (variable.storage == spirv::StorageClass::storage_buffer ||
            variable.storage == spirv::StorageClass::uniform) {
            info.blocks.push_back(block_of(module, id, variable));
        } else if (variable.storage == spirv::StorageClass::push_constant) {
            const std::uint32_t struct_id = pointee(module, variable);
            info.push_members = members_of(module, struct_id);
            info.push_bytes = end_of_struct(module, struct_id, 0);
            add_addresses(module, struct_id, info);
        } else if (variable.storage == spirv::StorageClass::uniform_constant) {
            info.blocks.push_back(texels_of(module, id, variable));
        } else if (spirv::is_descriptor(variable.storage)) {
            spirv::fail("a resource is not a buffer");
        }
    }
    std::ranges::sort(info.blocks, {}, &BufferBlock::binding);
    check_blocks(info.blocks);
    check_pointers(module);
}

void add_constants(const Module& module, ProgramInfo& info) {
    for (const auto& [id, constant] : module.constants) {
        const auto spec_id = module.spec_id(id);
        if (!spec_id) continue;
        if (!constant.value) spirv::fail("a specialization constant is not of 32 bits");
        info.constants.push_back({.name = module.name(id), .id = *spec_id, .default_value = *constant.value});
    }
    std::ranges::sort(info.constants, {}, &SpecConstant::id);
    if (std::ranges::adjacent_find(info.constants, {}, &SpecConstant::id) != info.constants.end())
        spirv::fail("two specialization constants share a number");
}

void add_local_size(const Module& module, ProgramInfo& info) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        LocalSizeAxis& out = info.local_size[axis];
        out.size = module.local_size[axis];
        if (module.local_size_ids[axis] == 0) continue;
        const std::uint32_t id = module.local_size_ids[axis];
        out.size = module.constant(id);
        out.spec_id = module.spec_id(id);
    }
    for (const LocalSizeAxis& axis : info.local_size) {
        if (axis.size == 0) spirv::fail("a local size is 0");
    }
}

template <class Row>
const Row* find_named(const std::vector<Row>& rows, std::string_view name) {
    const auto found = std::ranges::find(rows, name, &Row::name);
    return found == rows.end() ? nullptr : &*found;
}

}  // namespace

const AddressMember* ProgramInfo::find_address(std::string_view name) const {
    return find_named(addresses, name);
}
const BufferBlock* ProgramInfo::find_block(std::string_view name) const {
    return find_named(blocks, name);
}
const SpecConstant* ProgramInfo::find_constant(std::string_view name) const {
    return find_named(constants, name);
}
const StructInfo* ProgramInfo::find_struct(std::string_view name) const {
    return find_named(structs, name);
}

ProgramInfo reflect(std::span<const std::uint32_t> words) {
    const Module module = spirv::parse(words);
    ProgramInfo info;
    info.capabilities = module.capabilities;
    add_variables(module, info);
    add_constants(module, info);
    add_local_size(module, info);
    info.structs = structs_of(module);
    return info;
}

}  // namespace voxilux
