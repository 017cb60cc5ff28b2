#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The parts of a SPIR-V module that reflection needs, as read from its words (SPIR-V 1.6 specification,
// section 3).
namespace voxilux::spirv {

// Throws InternalError("internal error: bad SPIR-V: ...").
[[noreturn]] void fail(std::string_view what);

enum class StorageClass : std::uint32_t {
    uniform_constant = 0,
    input = 1,
    uniform = 2,
    push_constant = 9,
    image = 11,
    storage_buffer = 12,
    physical_storage_buffer = 5349,
};
[[nodiscard]] bool is_descriptor(StorageClass storage);

struct Type {
    enum Kind { scalar, vector, matrix, array, runtime_array, structure, pointer, texels, other };
    Kind kind = other;
    std::uint32_t width_bits = 0;                // of a scalar
    std::uint32_t element = 0;                   // type id of the component, column, element or pointee
    std::uint32_t count = 0;                     // components or columns; for an array the id of its length
    std::vector<std::uint32_t> members;          // type ids
    StorageClass storage = StorageClass::input;  // that a pointer points into
};

struct Constant {
    std::optional<std::uint32_t> value;  // of 32-bit scalars and bools
};

struct Variable {
    std::uint32_t type = 0;
    StorageClass storage = StorageClass::input;
};

struct VariableFacts {
    std::optional<std::uint32_t> set;
    std::optional<std::uint32_t> binding;
    bool non_writable = false;
    bool non_readable = false;
};

struct MemberFacts {
    std::string name;
    std::optional<std::uint32_t> offset;
    std::uint32_t matrix_stride = 0;
    bool non_writable = false;
    bool non_readable = false;
};

// The decorations of one id that reflection knows.
struct Decorations {
    VariableFacts variable;
    std::optional<std::uint32_t> spec_id;
    std::uint32_t array_stride = 0;
    bool is_block = false;
    bool is_workgroup_size = false;
};

struct Module {
    std::map<std::uint32_t, std::string> names;
    std::map<std::pair<std::uint32_t, std::uint32_t>, MemberFacts> members;  // by struct id and member
    std::map<std::uint32_t, Decorations> decorations;
    std::map<std::uint32_t, Type> types;
    std::map<std::uint32_t, Constant> constants;
    std::map<std::uint32_t, std::vector<std::uint32_t>> composites;  // of constants
    std::map<std::uint32_t, Variable> variables;
    std::set<std::uint32_t> used_variables;  // variables that a function accesses
    std::vector<std::uint32_t> capabilities;
    std::array<std::uint32_t, 3> local_size{1, 1, 1};
    std::array<std::uint32_t, 3> local_size_ids{0, 0, 0};  // constants that override local_size; 0: none

    // Returns kind `other` when the module defines no type of that id that reflection knows.
    [[nodiscard]] const Type& type(std::uint32_t id) const;
    // Throws InternalError when there is no 32-bit constant of that id.
    [[nodiscard]] std::uint32_t constant(std::uint32_t id) const;

    // Returns empty values when there is nothing of that id.
    [[nodiscard]] std::string name(std::uint32_t id) const;
    [[nodiscard]] MemberFacts member(std::uint32_t struct_id, std::uint32_t index) const;
    [[nodiscard]] VariableFacts variable_facts(std::uint32_t id) const;
    [[nodiscard]] bool is_block(std::uint32_t id) const;
    [[nodiscard]] std::uint32_t array_stride(std::uint32_t id) const;
    [[nodiscard]] std::optional<std::uint32_t> spec_id(std::uint32_t id) const;
};

// Reads the words of a module with exactly one compute entry point. Throws InternalError on anything else.
[[nodiscard]] Module parse(std::span<const std::uint32_t> words);

}  // namespace voxilux::spirv
