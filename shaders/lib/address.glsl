// Access to a buffer by its address. Include this file before any other, because it requires extensions.
#ifndef VX_ADDRESS_GLSL
#define VX_ADDRESS_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_subgroup_extended_types_int64 : require
#extension GL_KHR_shader_subgroup_ballot : require

// A pointer of the push block, of type Name, prepared for loads and stores: take it once, before any branch.
// Lavapipe holds a pointer as a vector of one address per invocation and spills it at every access. A value
// that comes from one invocation is held as a single address, which makes loads about five times faster,
// faster even than from a bound block, whose bounds it checks. That holds for elements of uint and uint64_t.
// Vectors are spilled all the same, so load two words as a uint64_t and unpack32() it.
#define VX_POINTER(Name, pointer) Name(subgroupBroadcastFirst(uint64_t(pointer)))

#endif
