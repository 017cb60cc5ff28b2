#include "voxelize/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <span>
#include <string_view>
#include <utility>

namespace voxilux {
namespace {

using Bytes = std::span<const std::byte>;

enum class Component : std::uint32_t {
    i8 = 5120,
    u8 = 5121,
    i16 = 5122,
    u16 = 5123,
    u32 = 5125,
    f32 = 5126,
};

std::size_t bytes_of(Component component) {
    switch (component) {
        case Component::i8:
        case Component::u8:
            return 1;
        case Component::i16:
        case Component::u16:
            return 2;
        default:
            return 4;
    }
}

Component read_component(const JsonItem& item) {
    const std::uint64_t code = require_count(item, "componentType");
    for (const Component known :
         {Component::i8, Component::u8, Component::i16, Component::u16, Component::u32, Component::f32}) {
        if (code == static_cast<std::uint32_t>(known)) return known;
    }
    throw MeshFault(fmt::format("{}.componentType {} is not one of glTF 2.0", item.name, code));
}

std::size_t read_width(const JsonItem& item) {
    constexpr std::pair<std::string_view, std::size_t> kWidths[] = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    const std::string type = read_text(item, "type", "");
    for (const auto& [name, width] : kWidths) {
        if (type == name) return width;
    }
    throw MeshFault(item.name + ".type is none of SCALAR, VEC2, VEC3, VEC4");
}

// Where the elements of a block lie: element i at first + i * stride.
struct Elements {
    Bytes bytes;
    std::size_t stride = 0;
    Component component = Component::f32;
    std::size_t width = 1;
    std::size_t count = 0;
};

struct ElementType {
    Component component = Component::f32;
    std::size_t width = 1;
};

// `count` elements from byteOffset of `item` in the view that it names. Products stay below 2^64: counts and
// strides come from JSON numbers of at most 2^53, so they are held against the view before they are
// multiplied.
Elements locate(GltfDocument& document, const JsonItem& item, const ElementType& type, std::uint64_t count) {
    const auto view = read_index(item, "bufferView", document.root, "bufferViews");
    if (!view) throw MeshFault(item.name + ".bufferView is missing");
    const Bytes bytes = view_bytes(document, *view);
    const JsonItem view_item = list_item(document.root, "bufferViews", *view);
    const std::uint64_t size = bytes_of(type.component) * type.width;
    const std::uint64_t stride = read_count(view_item, "byteStride").value_or(size);
    if (stride < size || stride > 65536)
        throw MeshFault(
            fmt::format("{}.byteStride {} does not fit elements of {} bytes", view_item.name, stride, size));
    const std::uint64_t offset = read_count(item, "byteOffset").value_or(0);
    if (offset > bytes.size() ||
        (count > 0 && (bytes.size() - offset < size || (bytes.size() - offset - size) / stride < count - 1)))
        throw MeshFault(
            fmt::format("{} reaches past its view: {} elements from byte {}, every {} bytes, in {}",
                        item.name, count, offset, stride, bytes.size()));
    return {bytes.subspan(static_cast<std::size_t>(offset)), static_cast<std::size_t>(stride), type.component,
            type.width, static_cast<std::size_t>(count)};
}

std::uint32_t bits_at(const std::byte* at, std::size_t size) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < size; ++i)
        bits |= std::to_integer<std::uint32_t>(at[i]) << (8 * i);
    return bits;
}

float value_at(const std::byte* at, Component component, bool is_normalized) {
    const std::uint32_t bits = bits_at(at, bytes_of(component));
    switch (component) {
        case Component::f32:
            return std::bit_cast<float>(bits);
        case Component::u32:
            return static_cast<float>(bits);
        case Component::u16:
            return is_normalized ? static_cast<float>(bits) / 65535.0f : static_cast<float>(bits);
        case Component::u8:
            return is_normalized ? static_cast<float>(bits) / 255.0f : static_cast<float>(bits);
        case Component::i16: {
            const auto value = static_cast<float>(static_cast<std::int16_t>(bits));
            return is_normalized ? std::max(value / 32767.0f, -1.0f) : value;
        }
        case Component::i8: {
            const auto value = static_cast<float>(static_cast<std::int8_t>(bits));
            return is_normalized ? std::max(value / 127.0f, -1.0f) : value;
        }
    }
    return 0.0f;
}

const std::byte* element(const Elements& elements, std::size_t index) {
    return elements.bytes.data() + index * elements.stride;
}

void copy_values(const Elements& from, std::size_t index, bool is_normalized, std::span<float> to) {
    const std::byte* at = element(from, index);
    for (float& value : to) {
        value = value_at(at, from.component, is_normalized);
        at += bytes_of(from.component);
    }
}

std::uint64_t read_element_count(const GltfDocument& document, const JsonItem& item) {
    const std::uint64_t count = require_count(item, "count");
    if (count > document.limits.vertices)
        throw MeshFault(fmt::format("{} has {} elements; at most {} are read", item.name, count,
                                    document.limits.vertices));
    return count;
}

// Calls put(place, elements, which) for each sparse element of `accessor`, which has `count` elements.
template <class Put>
void for_each_sparse(GltfDocument& document, const JsonItem& accessor, const ElementType& type, Put put) {
    if (!has(accessor, "sparse")) return;
    const JsonItem sparse = child(accessor, "sparse");
    const std::uint64_t count = read_element_count(document, accessor);
    const std::uint64_t stored = read_element_count(document, sparse);
    if (stored > count) throw MeshFault(sparse.name + ".count is above that of its accessor");
    const JsonItem indices = child(sparse, "indices");
    const Component index_type = read_component(indices);
    if (index_type != Component::u8 && index_type != Component::u16 && index_type != Component::u32)
        throw MeshFault(indices.name + ".componentType is not unsigned");
    const Elements places = locate(document, indices, {index_type, 1}, stored);
    const Elements values = locate(document, child(sparse, "values"), type, stored);
    for (std::size_t i = 0; i < stored; ++i) {
        const std::uint32_t place = bits_at(element(places, i), bytes_of(index_type));
        if (place >= count)
            throw MeshFault(fmt::format("{} names element {} of {}", indices.name, place, count));
        put(place, values, i);
    }
}

}  // namespace

AccessorValues read_accessor(GltfDocument& document, std::size_t index) {
    const JsonItem accessor = list_item(document.root, "accessors", index);
    const ElementType type = {read_component(accessor), read_width(accessor)};
    const bool is_normalized = read_flag(accessor, "normalized", false);
    AccessorValues result;
    const std::uint64_t count = read_element_count(document, accessor);
    std::optional<Elements> elements;
    if (has(accessor, "bufferView")) elements = locate(document, accessor, type, count);
    result.count = static_cast<std::size_t>(count);
    result.width = type.width;
    result.values.resize(result.count * result.width);
    const auto target = [&](std::size_t i) {
        return std::span(result.values).subspan(i * type.width, type.width);
    };
    for (std::size_t i = 0; elements && i < result.count; ++i)
        copy_values(*elements, i, is_normalized, target(i));
    for_each_sparse(document, accessor, type, [&](std::size_t place, const Elements& values, std::size_t i) {
        copy_values(values, i, is_normalized, target(place));
    });
    return result;
}

std::vector<std::uint32_t> read_vertex_indices(GltfDocument& document, std::size_t index,
                                               std::size_t vertex_count) {
    const JsonItem accessor = list_item(document.root, "accessors", index);
    const ElementType type = {read_component(accessor), read_width(accessor)};
    if (type.width != 1 || (type.component != Component::u8 && type.component != Component::u16 &&
                            type.component != Component::u32))
        throw MeshFault(accessor.name + " holds vertex indices, but is not an unsigned SCALAR");
    const std::uint64_t count = read_element_count(document, accessor);
    std::optional<Elements> elements;
    if (has(accessor, "bufferView")) elements = locate(document, accessor, type, count);
    std::vector<std::uint32_t> indices(static_cast<std::size_t>(count));
    const std::size_t size = bytes_of(type.component);
    for (std::size_t i = 0; elements && i < indices.size(); ++i)
        indices[i] = bits_at(element(*elements, i), size);
    for_each_sparse(document, accessor, type, [&](std::size_t place, const Elements& values, std::size_t i) {
        indices[place] = bits_at(element(values, i), size);
    });
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= vertex_count)
            throw MeshFault(fmt::format("{} element {} names vertex {} of {}", accessor.name, i, indices[i],
                                        vertex_count));
    }
    return indices;
}

}  // namespace voxilux
