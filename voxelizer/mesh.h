#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

[[nodiscard]] inline bool is_finite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// A mesh file as the voxelizer reads it (a point cloud has no triangles): triangles in the world space of the
// file (glTF: right handed, y up, metres), after all node transforms. Vertex attributes are shared by index.

enum class TextureWrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

struct Texture {
    std::string name;
    glm::ivec2 size{0};               // texels
    std::vector<glm::u8vec4> texels;  // row 0 is v = 0; as stored: sRGB for colours, linear for data
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    bool is_nearest = false;  // magnification without interpolation
};

// How a material reads a texture: uv' = transform (u, v, 1).
struct TextureUse {
    std::uint32_t texture = 0;  // of Mesh::textures
    std::uint32_t uv_set = 0;   // 0 or 1
    glm::dmat3 transform{1.0};  // KHR_texture_transform
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

// All factors linear.
struct MeshMaterial {
    std::string name;
    glm::vec4 base_color{1.0f};
    std::optional<TextureUse> base_color_texture;  // sRGB, alpha linear
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    float metallic = 1.0f;
    float roughness = 1.0f;
    std::optional<TextureUse> metallic_roughness_texture;  // blue is metallic, green is roughness
    glm::vec3 emissive{0.0f};                              // with KHR_materials_emissive_strength
    std::optional<TextureUse> emissive_texture;            // sRGB
    float transmission = 0.0f;                             // KHR_materials_transmission
    float ior = 1.5f;                                      // KHR_materials_ior
};

struct MeshTriangle {
    glm::uvec3 vertices{0};  // of Mesh::positions
    std::uint32_t material = 0;
};

struct MeshCamera {
    std::string name;
    glm::dvec3 position{0.0};
    glm::dvec3 forward{0.0, 0.0, -1.0};  // unit
    glm::dvec3 up{0.0, 1.0, 0.0};        // unit
    double fov_y_deg = 45.0;
};

struct Mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec2> uv0;     // as long as positions, or empty where no triangle has any
    std::vector<glm::vec2> uv1;     // likewise
    std::vector<glm::vec4> colors;  // likewise; linear, white where a part of the mesh has none
    std::vector<MeshTriangle> triangles;
    std::vector<MeshMaterial> materials;  // at least one
    std::vector<Texture> textures;
    std::vector<MeshCamera> cameras;
    bool is_z_up = false;               // else y points up
    std::vector<std::string> warnings;  // what was dropped or replaced while loading, one counted line each
};

}  // namespace voxilux
