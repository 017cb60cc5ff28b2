// The bridge that lets the headers of this folder compile as C++20 (namespace voxilux::gpu, vectors from GLM)
// and as GLSL 4.60. Rules of the portable subset: swizzles of one component only (.x .y .z .w), suffixes 1.0f
// and 1u on every literal, comparisons of vectors component by component, results returned as structs,
// constants from limits.h, and VX_PRECISE on every float whose exact bits matter (drivers re-associate the
// others).
#ifndef VX_PORTABLE_H
#define VX_PORTABLE_H

#ifdef __cplusplus

#include <cmath>
#include <cstdint>
#include <cstring>

#include <glm/glm.hpp>

#define VX_FN inline
#define VX_PRECISE
#define VX_CONST(type, name, value) inline constexpr type name = value
#define VX_CONST_LIST(type, name, count) inline constexpr type name[count]
#define VX_BEGIN namespace voxilux::gpu {
#define VX_END }

namespace voxilux::gpu {
using glm::ivec2;
using glm::ivec3;
using glm::mat4;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;

using glm::abs;
using glm::clamp;
using glm::cross;
using glm::distance;
using glm::dot;
using glm::exp;
using glm::floor;
using glm::inverse;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::outerProduct;
using glm::packHalf2x16;
using glm::pow;
using glm::unpackHalf2x16;
using std::acos;
using std::cos;
using std::isinf;
using std::isnan;
using std::sin;
using std::sqrt;

inline uint floatBitsToUint(float x) {
    uint bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}
inline float uintBitsToFloat(uint bits) {
    float x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}
inline float roundEven(float x) {
    return std::nearbyint(x);
}
inline float atan(float y, float x) {
    return std::atan2(y, x);
}
inline uint bitfieldReverse(uint v) {
    v = ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
    v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
    v = ((v >> 4) & 0x0F0F0F0Fu) | ((v & 0x0F0F0F0Fu) << 4);
    v = ((v >> 8) & 0x00FF00FFu) | ((v & 0x00FF00FFu) << 8);
    return (v >> 16) | (v << 16);
}
}  // namespace voxilux::gpu

#else  // GLSL

#define VX_FN
#define VX_PRECISE precise
#define VX_CONST(type, name, value) const type name = value
#define VX_CONST_LIST(type, name, count) const type name[count]
#define VX_BEGIN
#define VX_END

#endif

#endif
