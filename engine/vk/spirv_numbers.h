#pragma once

#include <cstddef>
#include <cstdint>

// Numbers of the SPIR-V 1.6 specification (section 3) that reflection reads.
namespace voxilux::spirv {

inline constexpr std::uint32_t kMagic = 0x07230203u;
inline constexpr std::size_t kHeaderWords = 5;

enum Op : std::uint32_t {
    op_name = 5,
    op_member_name = 6,
    op_entry_point = 15,
    op_execution_mode = 16,
    op_capability = 17,
    op_type_bool = 20,
    op_type_int = 21,
    op_type_float = 22,
    op_type_vector = 23,
    op_type_matrix = 24,
    op_type_image = 25,
    op_type_array = 28,
    op_type_runtime_array = 29,
    op_type_struct = 30,
    op_type_pointer = 32,
    op_constant_true = 41,
    op_constant_false = 42,
    op_constant = 43,
    op_constant_composite = 44,
    op_spec_constant_true = 48,
    op_spec_constant_false = 49,
    op_spec_constant = 50,
    op_spec_constant_composite = 51,
    op_function_call = 57,
    op_variable = 59,
    op_load = 61,
    op_store = 62,
    op_copy_memory = 63,
    op_access_chain = 65,
    op_in_bounds_access_chain = 66,
    op_ptr_access_chain = 67,
    op_array_length = 68,
    op_in_bounds_ptr_access_chain = 70,
    op_decorate = 71,
    op_member_decorate = 72,
    op_execution_mode_id = 331,
};

enum DecorationNumber : std::uint32_t {
    decoration_spec_id = 1,
    decoration_block = 2,
    decoration_array_stride = 6,
    decoration_matrix_stride = 7,
    decoration_built_in = 11,
    decoration_non_writable = 24,
    decoration_non_readable = 25,
    decoration_binding = 33,
    decoration_descriptor_set = 34,
    decoration_offset = 35,
};

inline constexpr std::uint32_t kDimBuffer = 5;
inline constexpr std::uint32_t kImageIsStorage = 2;
inline constexpr std::uint32_t kFormatRgba32ui = 30;
inline constexpr std::uint32_t kFormatR32ui = 33;
inline constexpr std::uint32_t kModelGlCompute = 5;
inline constexpr std::uint32_t kModeLocalSize = 17;
inline constexpr std::uint32_t kModeLocalSizeId = 38;
inline constexpr std::uint32_t kBuiltInWorkgroupSize = 25;

}  // namespace voxilux::spirv
