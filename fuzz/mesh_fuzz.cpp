// libFuzzer target of the mesh readers: glTF, GLB, OBJ, MTL, STL, PLY and LAS. Property: whatever the bytes,
// the reader stays within its memory bound and either refuses with one line or returns a mesh whose numbers
// are finite and whose indices are inside its lists.

#include <cmath>
#include <string_view>

#include "require.h"
#include "support/allocation_counter.h"
#include "voxelizer/load_gltf.h"
#include "voxelizer/load_las.h"
#include "voxelizer/load_mtl.h"
#include "voxelizer/load_obj.h"
#include "voxelizer/load_ply.h"
#include "voxelizer/load_stl.h"
#include "voxelizer/texture_sample.h"

namespace {

using namespace voxilux;

// Small limits, so that small inputs can exceed the memory bound. What they admit fits the fixed part: 64
// bytes for the attributes of a vertex and as much for reading them, 16 for a triangle, 4 for a texel; lists
// double as they grow.
constexpr MeshLimits kLimits{.vertices = 1 << 16,
                             .triangles = 1 << 16,
                             .parts = 1 << 12,
                             .texels_per_image = 1 << 14,
                             .texels = 1 << 16,
                             .file_bytes = 1 << 16};
constexpr std::size_t kFixedBytes = std::size_t{48} << 20;
constexpr std::size_t kBytesPerByte = 1024;  // 3 bytes of JSON become a tinygltf material of 2 kB

bool is_finite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void check_use(const Mesh& mesh, const std::optional<TextureUse>& use) {
    if (use) require(use->texture < mesh.textures.size() && use->uv_set < 2, "a texture is not there");
}

void check(const Mesh& mesh) {
    for (const auto* uvs : {&mesh.uv0, &mesh.uv1})
        require(uvs->empty() || uvs->size() == mesh.positions.size(), "texture coordinates are too few");
    require(mesh.colors.empty() || mesh.colors.size() == mesh.positions.size(), "colours are too few");
    for (const MeshTriangle& triangle : mesh.triangles) {
        require(triangle.material < mesh.materials.size(), "a material is not there");
        for (int c = 0; c < 3; ++c) {
            require(triangle.vertices[c] < mesh.positions.size(), "a vertex is not there");
            require(is_finite(mesh.positions[triangle.vertices[c]]), "a vertex is not finite");
        }
    }
    for (const MeshMaterial& material : mesh.materials) {
        check_use(mesh, material.base_color_texture);
        check_use(mesh, material.metallic_roughness_texture);
        check_use(mesh, material.emissive_texture);
    }
    for (const MeshCamera& camera : mesh.cameras)
        require(is_finite(camera.position) && is_finite(camera.forward) && is_finite(camera.up),
                "a camera is not finite");
    const MaterialSampler sampler(mesh);
    for (std::uint32_t i = 0; i < mesh.materials.size(); ++i) {
        const SurfaceColor color = sampler.sample(i, {.uv0 = {7.3f, -2.1f}, .span0 = glm::mat2(0.7f)});
        require(is_finite(glm::dvec3(color.base_color)) && color.base_color.r >= 0.0f, "a colour is invalid");
    }
}

Mesh load(std::span<const std::byte> bytes, MeshNotes& notes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const MeshRequest request{.limits = kLimits};
    const bool is_gltf = text.starts_with('{') || text.starts_with("glTF");
    if (is_gltf) return load_gltf(bytes, "no-such-folder", request, notes);
    if (text.starts_with("ply")) return load_ply(bytes, "no-such-folder", request, notes);
    if (text.starts_with("LASF")) return load_las(bytes, "no-such-folder", request, notes);
    if (text.starts_with("solid")) return load_stl(bytes, "no-such-folder", request, notes);
    Mesh materials;
    MtlLibrary library{
        .folder = "no-such-folder", .budget = {.limits = kLimits}, .materials = {}, .textures = {}};
    if (text.starts_with("newmtl")) {
        read_mtl(text, library, materials, notes);
        return materials;
    }
    return load_obj(bytes, "no-such-folder", request, notes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const PeakAllocation peak;
    try {
        MeshNotes notes;
        const Mesh mesh = load(std::as_bytes(std::span(data, size)), notes);
        require(peak.bytes() <= kFixedBytes + kBytesPerByte * size,
                "a reader takes more memory than it promises");
        check(mesh);
        require(note_lines(notes).size() <= kMaxNoteLines + 1, "too many notes");
    } catch (const MeshFault& fault) {
        require(std::string_view(fault.what()) != "", "a refusal gives no reason");
        require(peak.bytes() <= kFixedBytes + kBytesPerByte * size,
                "a refusal takes more memory than promised");
    }
    return 0;
}
