#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "voxelize/gltf_json.h"
#include "voxelize/load_mesh.h"

namespace voxilux {

// The JSON of a .gltf or .glb file, and the buffers that were read so far.
struct GltfDocument {
    std::filesystem::path folder;
    MeshLimits limits;
    std::shared_ptr<const nlohmann::json> json;  // what `root` points into
    JsonItem root;
    std::optional<std::vector<std::byte>> binary;                // the BIN chunk of a .glb file
    std::vector<std::optional<std::vector<std::byte>>> buffers;  // of "buffers"; empty until they are read
};

// The document of a file's bytes: its container, version and required extensions are checked here, the rest
// where it is read. Throws MeshFault. Source: glTF 2.0 specification, sections 3 and 4.
[[nodiscard]] GltfDocument parse_gltf(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                                      const MeshLimits& limits);

// The bytes of bufferViews[index], inside its buffer. They live as long as the document.
[[nodiscard]] std::span<const std::byte> view_bytes(GltfDocument& document, std::size_t index);

// The bytes behind a buffer's or an image's "uri": decoded, or read from the folder of the file.
[[nodiscard]] std::vector<std::byte> uri_bytes(const GltfDocument& document, const std::string& uri);

}  // namespace voxilux
