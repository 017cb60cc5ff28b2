#include "voxelizer/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <span>
#include <string>

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

Component checked_component(int code, const std::string& owner) {
    for (const Component known :
         {Component::i8, Component::u8, Component::i16, Component::u16, Component::u32, Component::f32}) {
        if (code == static_cast<int>(known)) return known;
    }
    throw MeshFault(fmt::format("{}.componentType {} is not one of glTF 2.0", owner, code));
}

std::size_t width_of(const tinygltf::Accessor& accessor, const std::string& name) {
    switch (accessor.type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        default:
            throw MeshFault(name + ".type is none of SCALAR, VEC2, VEC3, VEC4");
    }
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

// A block of elements as given by the model, and its name in messages.
struct ByteBlock {
    std::string name;
    int view = -1;
    std::uint64_t offset = 0;
};

// Locates `count` elements of a block. Products stay below 2^64: counts, offsets and strides are checked
// against the view before they are multiplied.
Elements locate(const GltfDocument& document, const ByteBlock& block, const ElementType& type,
                std::uint64_t count) {
    const auto& views = document.model.bufferViews;
    const auto view = checked_index(block.view, views.size(), block.name + ".bufferView", "bufferViews");
    if (!view) throw MeshFault(block.name + ".bufferView is missing");
    const Bytes bytes = view_bytes(document, *view);
    const std::uint64_t size = bytes_of(type.component) * type.width;
    const std::uint64_t stride = views[*view].byteStride == 0 ? size : views[*view].byteStride;
    if (stride < size || stride > 65536)
        throw MeshFault(fmt::format("bufferViews[{}].byteStride {} does not fit elements of {} bytes", *view,
                                    stride, size));
    if (block.offset > bytes.size() ||
        (count > 0 &&
         (bytes.size() - block.offset < size || (bytes.size() - block.offset - size) / stride < count - 1)))
        throw MeshFault(
            fmt::format("{} reaches past its view: {} elements from byte {}, every {} bytes, in {}",
                        block.name, count, block.offset, stride, bytes.size()));
    return {bytes.subspan(static_cast<std::size_t>(block.offset)), static_cast<std::size_t>(stride),
            type.component, type.width, static_cast<std::size_t>(count)};
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

std::uint64_t checked_count(const GltfDocument& document, std::uint64_t count, const std::string& name) {
    if (count > document.limits.vertices)
        throw MeshFault(
            fmt::format("{} has {} elements; at most {} are read", name, count, document.limits.vertices));
    return count;
}

// accessors[index], checked except for its ranges.
struct Source {
    const tinygltf::Accessor& accessor;
    std::string name;
    ElementType type;
    std::size_t count = 0;
    std::optional<Elements> elements;  // zeros if absent
};

Source read_source(const GltfDocument& document, std::size_t index) {
    const tinygltf::Accessor& accessor = document.model.accessors.at(index);
    const std::string name = fmt::format("accessors[{}]", index);
    Source source{.accessor = accessor,
                  .name = name,
                  .type = {checked_component(accessor.componentType, name), width_of(accessor, name)},
                  .elements = {}};
    source.count = static_cast<std::size_t>(checked_count(document, accessor.count, name));
    if (accessor.bufferView != -1)
        source.elements =
            locate(document, {name, accessor.bufferView, accessor.byteOffset}, source.type, source.count);
    return source;
}

bool is_unsigned(Component component) {
    return component == Component::u8 || component == Component::u16 || component == Component::u32;
}

// Calls put(place, elements, which) for each sparse element of `source`.
template <class Put>
void for_each_sparse(const GltfDocument& document, const Source& source, Put put) {
    const auto& sparse = source.accessor.sparse;
    if (!sparse.isSparse) return;
    const std::string name = source.name + ".sparse";
    // A number below 0, which the form of a document excludes, would be far above every limit.
    const std::uint64_t stored = checked_count(document, static_cast<std::uint64_t>(sparse.count), name);
    if (stored > source.count) throw MeshFault(name + ".count is above that of its accessor");
    const Component index_type = checked_component(sparse.indices.componentType, name + ".indices");
    if (!is_unsigned(index_type)) throw MeshFault(name + ".indices.componentType is not unsigned");
    const Elements places = locate(
        document,
        {name + ".indices", sparse.indices.bufferView, static_cast<std::uint64_t>(sparse.indices.byteOffset)},
        {index_type, 1}, stored);
    const Elements values = locate(
        document,
        {name + ".values", sparse.values.bufferView, static_cast<std::uint64_t>(sparse.values.byteOffset)},
        source.type, stored);
    for (std::size_t i = 0; i < stored; ++i) {
        const std::uint32_t place = bits_at(element(places, i), bytes_of(index_type));
        if (place >= source.count)
            throw MeshFault(fmt::format("{}.indices names element {} of {}", name, place, source.count));
        put(place, values, i);
    }
}

}  // namespace

AccessorValues read_accessor(const GltfDocument& document, std::size_t index) {
    const Source source = read_source(document, index);
    const bool is_normalized = source.accessor.normalized;
    const std::size_t width = source.type.width;
    AccessorValues result{.count = source.count, .width = width, .values = {}};
    result.values.resize(result.count * width);
    const auto target = [&](std::size_t i) { return std::span(result.values).subspan(i * width, width); };
    for (std::size_t i = 0; source.elements && i < result.count; ++i)
        copy_values(*source.elements, i, is_normalized, target(i));
    for_each_sparse(document, source, [&](std::size_t place, const Elements& values, std::size_t i) {
        copy_values(values, i, is_normalized, target(place));
    });
    return result;
}

std::vector<std::uint32_t> read_vertex_indices(const GltfDocument& document, std::size_t index,
                                               std::size_t vertex_count) {
    const Source source = read_source(document, index);
    if (source.type.width != 1 || !is_unsigned(source.type.component))
        throw MeshFault(source.name + " holds vertex indices, but is not an unsigned SCALAR");
    std::vector<std::uint32_t> indices(source.count);
    const std::size_t size = bytes_of(source.type.component);
    for (std::size_t i = 0; source.elements && i < indices.size(); ++i)
        indices[i] = bits_at(element(*source.elements, i), size);
    for_each_sparse(document, source, [&](std::size_t place, const Elements& values, std::size_t i) {
        indices[place] = bits_at(element(values, i), size);
    });
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= vertex_count)
            throw MeshFault(
                fmt::format("{} element {} names vertex {} of {}", source.name, i, indices[i], vertex_count));
    }
    return indices;
}

}  // namespace voxilux
