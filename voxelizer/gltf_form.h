#pragma once

#include <nlohmann/json.hpp>

namespace voxilux {

// The part of a glTF document that a mesh is read from, in a form that tinygltf reads without loss: only
// fields of glTF 2.0 with their right types, integers inside the range that tinygltf keeps, nothing nested
// deeper than the format itself. Extras, animations and skins are left out. References are not checked.
// Throws MeshFault with the name of the field that is wrong or missing.
[[nodiscard]] nlohmann::json gltf_form(const nlohmann::json& document);

}  // namespace voxilux
