#include "voxelizer/mesh_features.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/printable.h"

namespace voxilux {
namespace {

using enum FeatureFate;

constexpr FeatureKind kGltf = FeatureKind::gltf_extension;
constexpr FeatureKind kMtl = FeatureKind::mtl_keyword;
constexpr FeatureKind kMap = FeatureKind::mtl_map_option;
constexpr FeatureKind kObj = FeatureKind::obj_keyword;

constexpr std::string_view kOneLobe = "is left out: a voxel is diffuse, metal, glass or an emitter";
constexpr std::string_view kFactorOnly = "is left out: a texture of this property is not read";
constexpr std::string_view kClearGlass = "is left out: glass is clear inside";
constexpr std::string_view kAtRest = "is left out: the mesh is read in its rest pose";
constexpr std::string_view kOnlyVoxelsEmit = "is left out: in a .vox file only voxels emit";
constexpr std::string_view kPlainMap = "is left out: the texture is read as it is";
constexpr std::string_view kNoFreeForm = "is left out: free-form curves and surfaces are not read";
constexpr std::string_view kNoCommands = "is left out: only the file itself is read";

// Sources: the glTF 2.0 extension registry of Khronos (KHR_, and EXT_ of several vendors); Alias/Wavefront,
// "Object Files" and "MTL material format", 1995; the fields of T. Fidler, "Extending the Wavefront MTL
// format for physically based rendering", 2015.
constexpr MeshFeature kFeatures[] = {
    {kGltf, "KHR_animation_pointer", noted, kAtRest},
    {kGltf, "KHR_draco_mesh_compression", fallback},
    {kGltf, "KHR_gaussian_splatting", noted, "is left out: splats are not read"},
    {kGltf, "KHR_interactivity", no_effect},
    {kGltf, "KHR_lights_punctual", noted, kOnlyVoxelsEmit},
    {kGltf, "KHR_materials_anisotropy", noted, kOneLobe},
    {kGltf, "KHR_materials_clearcoat", noted, kOneLobe},
    {kGltf, "KHR_materials_diffuse_transmission", noted, kOneLobe},
    {kGltf, "KHR_materials_dispersion", noted, "is left out: glass has one refractive index"},
    {kGltf, "KHR_materials_emissive_strength", read},
    {kGltf, "KHR_materials_ior", read},
    {kGltf, "KHR_materials_iridescence", noted, kOneLobe},
    {kGltf, "KHR_materials_pbrSpecularGlossiness", noted, "is read without its specular colour"},
    {kGltf, "KHR_materials_sheen", noted, kOneLobe},
    {kGltf, "KHR_materials_specular", noted, kOneLobe},
    {kGltf, "KHR_materials_transmission", read},
    {kGltf, "KHR_materials_unlit", noted, "is read as a diffuse surface"},
    {kGltf, "KHR_materials_variants", noted, "is left out: the default variant is read"},
    {kGltf, "KHR_materials_volume", noted, kClearGlass},
    {kGltf, "KHR_materials_volume_scatter", noted, kClearGlass},
    {kGltf, "KHR_mesh_quantization", read},
    {kGltf, "KHR_meshopt_compression", fallback},
    {kGltf, "KHR_node_hoverability", no_effect},
    {kGltf, "KHR_node_selectability", no_effect},
    {kGltf, "KHR_node_visibility", read},
    {kGltf, "KHR_techniques_webgl", noted, "is left out: shaders of a file are not run"},
    {kGltf, "KHR_texture_basisu", fallback},
    {kGltf, "KHR_texture_transform", read},
    {kGltf, "KHR_xmp", no_effect},
    {kGltf, "KHR_xmp_json_ld", no_effect},
    {kGltf, "EXT_instance_features", no_effect},
    {kGltf, "EXT_lights_ies", noted, kOnlyVoxelsEmit},
    {kGltf, "EXT_lights_image_based", noted, "is left out: the sky is a setting of the scene"},
    {kGltf, "EXT_materials_bump", no_effect},
    {kGltf, "EXT_mesh_features", no_effect},
    {kGltf, "EXT_mesh_gpu_instancing", read},
    {kGltf, "EXT_mesh_manifold", no_effect},
    {kGltf, "EXT_mesh_primitive_restart", fallback},
    {kGltf, "EXT_meshopt_compression", fallback},
    {kGltf, "EXT_structural_metadata", no_effect},
    {kGltf, "EXT_texture_avif", fallback},
    {kGltf, "EXT_texture_webp", fallback},

    {kMtl, "newmtl", read},
    {kMtl, "Kd", read},
    {kMtl, "Ke", read},
    {kMtl, "Tf", read},
    {kMtl, "illum", read},
    {kMtl, "d", read},
    {kMtl, "Tr", read},
    {kMtl, "Ns", read},
    {kMtl, "Ni", read},
    {kMtl, "Pm", read},
    {kMtl, "Pr", read},
    {kMtl, "map_Kd", read},
    {kMtl, "map_Ke", read},
    {kMtl, "map_d", read},
    {kMtl, "Ka", no_effect},  // ambient light is a result here, not a setting
    {kMtl, "map_Ka", no_effect},
    {kMtl, "Pcr", no_effect},        // of Pc
    {kMtl, "sharpness", no_effect},  // of refl
    {kMtl, "map_aat", no_effect},    // textures are always antialiased
    {kMtl, "bump", no_effect},       // a voxel has the normals of its faces
    {kMtl, "map_bump", no_effect},
    {kMtl, "map_Bump", no_effect},
    {kMtl, "norm", no_effect},
    {kMtl, "map_Kn", no_effect},
    {kMtl, "Ks", noted, kOneLobe},
    {kMtl, "Ps", noted, kOneLobe},
    {kMtl, "Pc", noted, kOneLobe},
    {kMtl, "aniso", noted, kOneLobe},
    {kMtl, "anisor", noted, kOneLobe},
    {kMtl, "map_Ks", noted, kOneLobe},
    {kMtl, "map_Ps", noted, kOneLobe},
    {kMtl, "map_Pc", noted, kOneLobe},
    {kMtl, "map_Pcr", noted, kOneLobe},
    {kMtl, "map_Ns", noted, kFactorOnly},
    {kMtl, "map_Pm", noted, kFactorOnly},
    {kMtl, "map_Pr", noted, kFactorOnly},
    {kMtl, "map_Tr", noted, kFactorOnly},
    {kMtl, "map_Tf", noted, kFactorOnly},
    {kMtl, "map_RMA", noted, kFactorOnly},
    {kMtl, "map_ORM", noted, kFactorOnly},
    {kMtl, "decal", noted, kFactorOnly},
    {kMtl, "disp", noted, "is left out: the surface is read without displacement"},
    {kMtl, "refl", noted, "is left out: reflections are those of the scene"},

    {kMap, "-s", read},
    {kMap, "-o", read},
    {kMap, "-clamp", read},
    {kMap, "-blendu", no_effect},  // these four control filtering; textures are averaged over each voxel
    {kMap, "-blendv", no_effect},
    {kMap, "-boost", no_effect},
    {kMap, "-texres", no_effect},
    {kMap, "-bm", no_effect},    // of bump
    {kMap, "-type", no_effect},  // of refl
    {kMap, "-cc", noted, kPlainMap},
    {kMap, "-imfchan", noted, kPlainMap},
    {kMap, "-mm", noted, kPlainMap},
    {kMap, "-t", noted, kPlainMap},

    {kObj, "v", read},
    {kObj, "vt", read},
    {kObj, "f", read},
    {kObj, "mtllib", read},
    {kObj, "usemtl", read},
    {kObj, "vn", no_effect},
    {kObj, "o", no_effect},
    {kObj, "g", no_effect},
    {kObj, "s", no_effect},
    {kObj, "mg", no_effect},
    {kObj, "bevel", no_effect},
    {kObj, "c_interp", no_effect},
    {kObj, "d_interp", no_effect},
    {kObj, "lod", no_effect},
    {kObj, "shadow_obj", no_effect},
    {kObj, "trace_obj", no_effect},
    {kObj, "vp", no_effect},  // these twelve describe the curves and surfaces noted below
    {kObj, "cstype", no_effect},
    {kObj, "deg", no_effect},
    {kObj, "bmat", no_effect},
    {kObj, "step", no_effect},
    {kObj, "parm", no_effect},
    {kObj, "trim", no_effect},
    {kObj, "hole", no_effect},
    {kObj, "scrv", no_effect},
    {kObj, "sp", no_effect},
    {kObj, "end", no_effect},
    {kObj, "con", no_effect},
    {kObj, "ctech", no_effect},
    {kObj, "stech", no_effect},
    {kObj, "curv", noted, kNoFreeForm},
    {kObj, "curv2", noted, kNoFreeForm},
    {kObj, "surf", noted, kNoFreeForm},
    {kObj, "bsp", noted, kNoFreeForm},
    {kObj, "bzp", noted, kNoFreeForm},
    {kObj, "cdc", noted, kNoFreeForm},
    {kObj, "cdp", noted, kNoFreeForm},
    {kObj, "res", no_effect},
    {kObj, "fo", noted, "is left out: the keyword of faces is f"},
    {kObj, "p", noted, "is left out: points have no surface"},
    {kObj, "l", noted, "is left out: lines have no surface"},
    {kObj, "maplib", noted, kNoCommands},
    {kObj, "usemap", noted, kNoCommands},
    {kObj, "call", noted, kNoCommands},
    {kObj, "csh", noted, kNoCommands},
};

std::string_view noun_of(FeatureKind kind) {
    switch (kind) {
        case FeatureKind::gltf_extension:
            return "the extension";
        case FeatureKind::mtl_keyword:
            return "the MTL keyword";
        case FeatureKind::mtl_map_option:
            return "the option of a texture";
        case FeatureKind::obj_keyword:
            return "the OBJ keyword";
    }
    return "";
}

}  // namespace

std::span<const MeshFeature> mesh_features() {
    return kFeatures;
}

const MeshFeature* find_feature(FeatureKind kind, std::string_view name) {
    const auto* const found = std::ranges::find_if(
        kFeatures, [&](const MeshFeature& row) { return row.kind == kind && row.name == name; });
    return found == std::end(kFeatures) ? nullptr : found;
}

void note_feature(FeatureKind kind, std::string_view name, MeshNotes& notes, std::size_t uses) {
    const MeshFeature* row = find_feature(kind, name);
    if (row == nullptr)
        notes[fmt::format("{} {} is not known and is left out", noun_of(kind), quoted_name(name))] += uses;
    else if (row->fate == FeatureFate::noted)
        notes[fmt::format("{} {}", name, row->said)] += uses;
}

}  // namespace voxilux
