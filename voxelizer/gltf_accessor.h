#pragma once

#include <cstdint>
#include <vector>

#include "voxelizer/gltf_document.h"

namespace voxilux {

// Elements of an accessor, component by component: element i starts at values[i * width].
struct AccessorValues {
    std::size_t count = 0;
    std::size_t width = 0;  // components of an element
    std::vector<float> values;
};

// accessors[index] as floats, normalised if it says so, with sparse values inserted. Each range is checked in
// 64 bits against its view before it is read. Throws MeshFault, also where it has more than limits.vertices
// elements. Source: glTF 2.0 specification, section 3.6.2 and 3.11.
[[nodiscard]] AccessorValues read_accessor(const GltfDocument& document, std::size_t index);

// The same for indices: a SCALAR accessor of unsigned integers below `vertex_count`.
[[nodiscard]] std::vector<std::uint32_t> read_vertex_indices(const GltfDocument& document, std::size_t index,
                                                             std::size_t vertex_count);

}  // namespace voxilux
