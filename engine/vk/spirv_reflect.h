#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxilux {

// How a shader sees a buffer: as a storage block, as a uniform block (small, the same values for all
// invocations), or as texels of four words or of one (a storage texel buffer).
enum class BlockKind { storage, uniform, texels, words };

// A buffer of a shader. `name` is the block's name: "Hits" of `readonly buffer Hits { Hit hits[]; };`.
struct BufferBlock {
    std::string name;
    std::uint32_t set = 0;
    std::uint32_t binding = 0;
    bool readable = true;
    bool writable = true;
    BlockKind kind = BlockKind::storage;
};

// A pointer in the push struct to a buffer that the shader reaches by address. Pointers are the first
// members, one after the other from offset 0.
struct AddressMember {
    std::string name;
    bool readable = true;
    bool writable = true;
};
inline constexpr std::uint32_t kAddressBytes = 8;

struct StructMember {
    std::string name;
    std::uint32_t offset = 0;  // bytes from the start of the struct

    bool operator==(const StructMember&) const = default;
};

// A struct type with a memory layout: blocks, the push struct and the structs inside them.
struct StructInfo {
    std::string name;
    std::vector<StructMember> members;
    std::uint32_t size_bytes = 0;    // end of the last member; 0 when it ends in an array without a length
    std::uint32_t array_stride = 0;  // bytes from element to element of an array of it; 0 when there is none
};

// A specialization constant. `name` is empty for those that only give the local size.
struct SpecConstant {
    std::string name;
    std::uint32_t id = 0;
    std::uint32_t default_value = 0;  // the 32 bits of an int, uint or float; 0 or 1 of a bool
};

// One axis of the local size; `spec_id` when a specialization constant overrides it.
struct LocalSizeAxis {
    std::uint32_t size = 1;
    std::optional<std::uint32_t> spec_id;
};

// What the SPIR-V of a compute shader declares.
struct ProgramInfo {
    std::vector<BufferBlock> blocks;  // those that the shader uses, by binding
    std::array<LocalSizeAxis, 3> local_size;
    std::uint32_t push_bytes = 0;  // of the push struct, its pointers included
    std::vector<StructMember> push_members;
    std::vector<AddressMember> addresses;  // in order of offset
    std::vector<SpecConstant> constants;   // by id
    std::vector<StructInfo> structs;
    std::vector<std::uint32_t> capabilities;  // numbers of SPIR-V capabilities

    // Null when there is none of that name.
    [[nodiscard]] const BufferBlock* find_block(std::string_view name) const;
    [[nodiscard]] const AddressMember* find_address(std::string_view name) const;
    [[nodiscard]] const SpecConstant* find_constant(std::string_view name) const;
    [[nodiscard]] const StructInfo* find_struct(std::string_view name) const;
};

// Reads a module with one compute entry point whose only resources are buffers, bound or reached by pointers
// of the push struct (SPIR-V 1.6 specification, sections 2.3 and 3). Throws InternalError that says what is
// wrong: all shaders are the program's own.
[[nodiscard]] ProgramInfo reflect(std::span<const std::uint32_t> spirv);

}  // namespace voxilux
