#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace voxilux {

// Returns the bytes of buffers[index], exactly its byteLength.
using BufferReader = std::function<std::vector<unsigned char>(std::size_t index)>;

// tinygltf's model of a document in the form of gltf_form, with its buffers. Each "uri" of its buffers must
// be the index of the buffer, which is passed to `read_buffer`; images are not read. Throws MeshFault with
// tinygltf's reason.
[[nodiscard]] tinygltf::Model parse_model(nlohmann::json form, const BufferReader& read_buffer);

// An index of the model into a list of `size`; nothing for -1, which means absent. Throws MeshFault when it
// is out of range: "nodes[2].mesh names meshes[9], but there are 3".
[[nodiscard]] std::optional<std::size_t> checked_index(int index, std::size_t size, const std::string& owner,
                                                       const char* list);

}  // namespace voxilux
