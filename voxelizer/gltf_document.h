#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "voxelizer/gltf_model.h"
#include "voxelizer/load_mesh.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {

// What tinygltf read from a .gltf or .glb file. Nothing in the model is valid until checked: its indices may
// be out of range, and its ranges outside their buffers.
struct GltfDocument {
    std::filesystem::path folder;
    MeshLimits limits;
    tinygltf::Model model;  // its images are not read: each has its uri or bufferView
};

// Parses a file's bytes into a document with all of its buffers. Its container, version, required extensions
// and the types of its fields are checked here, the rest where it is read; extensions that are not read are
// noted. Throws MeshFault. Source: glTF 2.0 specification, sections 3 and 4.
[[nodiscard]] GltfDocument parse_gltf(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                                      const MeshLimits& limits, MeshNotes& notes);

// The bytes of bufferViews[index], inside its buffer. They live as long as the document.
[[nodiscard]] std::span<const std::byte> view_bytes(const GltfDocument& document, std::size_t index);

// The bytes behind the "uri" of an image: decoded, or read from the folder of the file.
[[nodiscard]] std::vector<std::byte> uri_bytes(const GltfDocument& document, const std::string& uri);

}  // namespace voxilux
