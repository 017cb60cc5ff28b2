// The table of mesh format features: each row keeps its promise, and no keyword of the formats is missing.

#include "voxelizer/mesh_features.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "support/gltf_builder.h"
#include "voxelizer/load_gltf.h"
#include "voxelizer/load_mtl.h"
#include "voxelizer/load_obj.h"

namespace voxilux {
namespace {

using gltf_builder::File;
using gltf_builder::json;

struct Loaded {
    std::string content;  // of the mesh, as text
    std::string notes;
    std::string refusal;
};

std::string content_of(const Mesh& mesh) {
    std::string text;
    for (const MeshTriangle& t : mesh.triangles) {
        for (int c = 0; c < 3; ++c) {
            const glm::dvec3 p = mesh.positions[t.vertices[c]];
            text += fmt::format("{:.6g} {:.6g} {:.6g} of {}\n", p.x, p.y, p.z, t.material);
        }
    }
    for (const MeshMaterial& m : mesh.materials) {
        text += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}\n", m.name, m.base_color.r, m.base_color.g,
                            m.base_color.a, static_cast<int>(m.alpha_mode), m.metallic, m.roughness,
                            m.emissive.r, m.emissive.g, m.transmission, m.ior, m.alpha_cutoff);
        if (m.base_color_texture)
            text += fmt::format("{} {}\n", m.base_color_texture->transform[0][0],
                                m.base_color_texture->transform[2][0]);
    }
    for (const Texture& texture : mesh.textures)
        text += fmt::format("{} {}\n", texture.name, static_cast<int>(texture.wrap_u));
    return text;
}

Loaded loaded(const std::function<Mesh(MeshNotes&)>& load) {
    MeshNotes notes;
    Loaded result;
    try {
        result.content = content_of(load(notes));
    } catch (const MeshFault& fault) {
        result.refusal = fault.what();
    }
    for (const std::string& line : note_lines(notes))
        result.notes += line + "\n";
    return result;
}

Loaded load(const File& file) {
    const std::string bytes = file.gltf();
    return loaded(
        [&](MeshNotes& notes) { return load_gltf(std::as_bytes(std::span(bytes)), "gone", {}, notes); });
}

Loaded load_materials(const std::string& text) {
    return loaded([&](MeshNotes& notes) {
        MtlLibrary library{.folder = "gone", .budget = {}, .materials = {}, .textures = {}};
        Mesh mesh;
        read_mtl("newmtl a\n" + text, library, mesh, notes);
        return mesh;
    });
}

Loaded load_object(const std::string& text) {
    const std::string whole = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1 2 3\n" + text;
    return loaded(
        [&](MeshNotes& notes) { return load_obj(std::as_bytes(std::span(whole)), "gone", {}, notes); });
}

std::vector<MeshFeature> rows(FeatureKind kind) {
    std::vector<MeshFeature> result;
    for (const MeshFeature& row : mesh_features()) {
        if (row.kind == kind) result.push_back(row);
    }
    return result;
}

bool holds(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

// Uses each supported extension in a way that changes the mesh.
const std::map<std::string, std::function<void(File&)>> kExtensionUses = {
    {"KHR_materials_emissive_strength",
     [](File& f) {
         f.root["materials"][0]["emissiveFactor"] = {1, 1, 1};
         f.root["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 4;
     }},
    {"KHR_materials_ior",
     [](File& f) { f.root["materials"][0]["extensions"]["KHR_materials_ior"]["ior"] = 2; }},
    {"KHR_materials_transmission",
     [](File& f) {
         f.root["materials"][0]["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 1;
     }},
    {"KHR_texture_transform",
     [](File& f) {
         f.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
               ["KHR_texture_transform"]["offset"] = {0.5, 0};
     }},
    {"KHR_mesh_quantization",
     [](File& f) {
         const int positions = f.accessor(f.view(gltf_builder::bytes_of(std::vector<std::int8_t>{
                                                     0, 0, 0, 0, 2, 0, 0, 0, 2, 2, 0, 0, 0, 2, 0, 0}),
                                                 4),
                                          5120, "VEC3", 4);
         f.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = positions;
         f.root["extensionsRequired"] = {"KHR_mesh_quantization"};
     }},
    {"KHR_node_visibility",
     [](File& f) { f.root["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false; }},
    {"EXT_mesh_gpu_instancing",
     [](File& f) {
         f.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
             f.floats({0, 0, 0, 2, 0, 0}, 3);
     }},
};

TEST(MeshFeatures, every_extension_is_read_without_effect_noted_or_refused) {
    const Loaded plain = load(gltf_builder::textured_square());
    ASSERT_EQ(plain.notes + plain.refusal, "");
    for (const MeshFeature& row : rows(FeatureKind::gltf_extension)) {
        const std::string name(row.name);
        File file = gltf_builder::textured_square();
        file.root["extensionsUsed"] = {name};
        file.root["materials"][0]["extensions"][name] = json::object();
        const Loaded used = load(file);
        EXPECT_EQ(used.refusal, "") << name;
        EXPECT_EQ(holds(used.notes, name), row.fate == FeatureFate::noted) << name << "\n" << used.notes;
        file.root["extensionsRequired"] = {name};
        EXPECT_EQ(holds(load(file).refusal, name), row.fate == FeatureFate::fallback) << name;
        const auto use = kExtensionUses.find(name);
        ASSERT_EQ(use != kExtensionUses.end(), row.fate == FeatureFate::read) << name;
        if (row.fate != FeatureFate::read) continue;
        File changed = gltf_builder::textured_square();
        use->second(changed);
        const Loaded read = load(changed);
        EXPECT_EQ(read.notes + read.refusal, "") << name;
        EXPECT_NE(read.content, plain.content) << name << " changes nothing";
    }
}

TEST(MeshFeatures, extension_that_no_row_names_is_noted_and_refused_where_it_is_required) {
    File file = gltf_builder::textured_square();
    file.root["materials"][0]["extensions"]["KHR_not_there"] = json::object();
    file.root["nodes"][0]["extensions"]["KHR_not_there"] = json::object();
    file.root["extras"]["extensions"]["KHR_in_extras"] = json::object();
    EXPECT_EQ(load(file).notes, "the extension 'KHR_not_there' is not known and is left out (2 times)\n");
    file.root["extensionsRequired"] = {"KHR_not_there"};
    EXPECT_TRUE(holds(load(file).refusal, "needs the extension 'KHR_not_there'"));
}

// A line whose keyword must make a difference, and the lines before it.
struct Use {
    std::string context, line;
};
const std::map<std::string, Use> kMtlUses = {
    {"newmtl", {"", "newmtl b"}},
    {"Kd", {"", "Kd 0.5 0.25 1"}},
    {"Ke", {"", "Ke 1 2 3"}},
    {"Tf", {"illum 6\n", "Tf 0.5 0.25 1"}},
    {"illum", {"Ni 1.5\n", "illum 9"}},
    {"d", {"", "d 0.5"}},
    {"Tr", {"", "Tr 0.5"}},
    {"Ns", {"", "Ns 6"}},
    {"Ni", {"", "Ni 1.3"}},
    {"Pm", {"", "Pm 0.5"}},
    {"Pr", {"", "Pr 0.25"}},
    {"map_Kd", {"", "map_Kd gone.png"}},
    {"map_Ke", {"", "map_Ke gone.png"}},
    {"map_d", {"", "map_d gone.png"}},
};

TEST(MeshFeatures, every_mtl_keyword_is_read_without_effect_or_noted) {
    const Loaded plain = load_materials("");
    for (const MeshFeature& row : rows(FeatureKind::mtl_keyword)) {
        const std::string name(row.name);
        const auto use = kMtlUses.find(name);
        ASSERT_EQ(use != kMtlUses.end(), row.fate == FeatureFate::read) << name;
        if (row.fate == FeatureFate::read) {
            const Loaded before = load_materials(use->second.context);
            const Loaded after = load_materials(use->second.context + use->second.line + "\n");
            EXPECT_NE(before.content + before.notes, after.content + after.notes) << name;
            continue;
        }
        for (const std::string words : {" 0.5 0.25 1", " -mm 0 1 gone.png"}) {
            const Loaded used = load_materials(name + words + "\n");
            EXPECT_EQ(holds(used.notes, name + " "), row.fate == FeatureFate::noted) << name << "\n"
                                                                                     << used.notes;
            EXPECT_EQ(used.content, plain.content) << name;
        }
        EXPECT_EQ(load_materials(name + " 0 0 0\n").notes, "") << name << ": zeros ask for nothing";
    }
    EXPECT_EQ(load_materials("Kq 1\n").notes, "the MTL keyword 'Kq' is not known and is left out\n");
}

TEST(MeshFeatures, every_option_of_a_texture_is_read_without_effect_or_noted) {
    const Loaded plain = load_materials("map_Kd gone.png\n");
    for (const MeshFeature& row : rows(FeatureKind::mtl_map_option)) {
        const std::string name(row.name);
        const std::string words = row.name == "-clamp" ? " on" : row.name == "-imfchan" ? " r" : " 2 3";
        const bool is_single = row.name == "-clamp" || row.name == "-imfchan";
        const Loaded used = load_materials(
            "map_Kd " + name +
            (is_single || row.fate == FeatureFate::read || row.name == "-mm" || row.name == "-t" ? words
                                                                                                 : " 2") +
            " gone.png\n");
        EXPECT_EQ(holds(used.notes, name + " "), row.fate == FeatureFate::noted) << name << "\n"
                                                                                 << used.notes;
        EXPECT_TRUE(holds(used.notes, "gone.png: cannot open")) << name << " took the file's name";
        EXPECT_EQ(used.content, plain.content) << "there is no picture";
    }
    EXPECT_EQ(load_materials("map_Kd -mm 0 1 -t 0 0 0 -cc off gone.png\n").notes, plain.notes);
    EXPECT_TRUE(holds(load_materials("map_Kd -q 1 gone.png\n").notes, "'-q' is not known"));
}

const std::map<std::string, std::string> kObjUses = {{"v", "v 1 1 1\nf 1 2 -1"},
                                                     {"vt", "vt 1 1\nf 1/9 2 3"},
                                                     {"f", "f 1 3 2"},
                                                     {"mtllib", "mtllib gone.mtl"},
                                                     {"usemtl", "usemtl a"}};

TEST(MeshFeatures, every_obj_keyword_is_read_without_effect_or_noted) {
    const Loaded plain = load_object("");
    for (const MeshFeature& row : rows(FeatureKind::obj_keyword)) {
        const std::string name(row.name);
        const auto use = kObjUses.find(name);
        ASSERT_EQ(use != kObjUses.end(), row.fate == FeatureFate::read) << name;
        const Loaded used = load_object((use != kObjUses.end() ? use->second : name + " 1 2 3") + "\n");
        if (row.fate == FeatureFate::read) {
            EXPECT_NE(used.content + used.notes + used.refusal, plain.content) << name;
            continue;
        }
        EXPECT_EQ(holds(used.notes, name + " "), row.fate == FeatureFate::noted) << name << "\n"
                                                                                 << used.notes;
        EXPECT_EQ(used.content, plain.content) << name;
    }
    EXPECT_EQ(load_object("vq 1\n").notes, "the OBJ keyword 'vq' is not known and is left out\n");
}

// Names that the table lacks.
std::vector<std::string> missing(FeatureKind kind, const std::vector<std::string>& names) {
    std::vector<std::string> result;
    for (const std::string& name : names) {
        if (find_feature(kind, name) == nullptr) result.push_back(name);
    }
    return result;
}

// The names as the registry and the specification list them.
TEST(MeshFeatures, table_knows_the_extensions_of_khronos_and_the_keywords_of_mtl) {
    const std::vector<std::string> khronos = {"KHR_animation_pointer",
                                              "KHR_draco_mesh_compression",
                                              "KHR_gaussian_splatting",
                                              "KHR_interactivity",
                                              "KHR_lights_punctual",
                                              "KHR_materials_anisotropy",
                                              "KHR_materials_clearcoat",
                                              "KHR_materials_dispersion",
                                              "KHR_materials_emissive_strength",
                                              "KHR_materials_ior",
                                              "KHR_materials_iridescence",
                                              "KHR_materials_sheen",
                                              "KHR_materials_specular",
                                              "KHR_materials_transmission",
                                              "KHR_materials_unlit",
                                              "KHR_materials_variants",
                                              "KHR_materials_volume",
                                              "KHR_mesh_quantization",
                                              "KHR_node_hoverability",
                                              "KHR_node_selectability",
                                              "KHR_node_visibility",
                                              "KHR_texture_basisu",
                                              "KHR_texture_transform",
                                              "KHR_xmp_json_ld",
                                              "EXT_lights_ies",
                                              "EXT_lights_image_based",
                                              "EXT_mesh_gpu_instancing",
                                              "EXT_mesh_manifold",
                                              "EXT_meshopt_compression",
                                              "EXT_texture_webp",
                                              "EXT_texture_avif",
                                              "KHR_xmp",
                                              "KHR_techniques_webgl",
                                              "KHR_materials_pbrSpecularGlossiness"};
    EXPECT_EQ(missing(FeatureKind::gltf_extension, khronos), std::vector<std::string>{});
    const std::vector<std::string> mtl = {
        "newmtl",  "Ka",        "Kd",    "Ks",     "Ke",       "Tf",     "illum",  "d",      "Tr",
        "Ns",      "sharpness", "Ni",    "map_Ka", "map_Kd",   "map_Ks", "map_Ke", "map_Ns", "map_d",
        "map_aat", "disp",      "decal", "bump",   "map_bump", "refl",   "Pm",     "Pr",     "Ps",
        "Pc",      "Pcr",       "aniso", "anisor", "norm",     "map_Pm", "map_Pr", "map_Ps"};
    EXPECT_EQ(missing(FeatureKind::mtl_keyword, mtl), std::vector<std::string>{});
    EXPECT_EQ(missing(FeatureKind::mtl_keyword, {"Kd", "Kq"}), std::vector<std::string>{"Kq"});
    std::set<std::pair<FeatureKind, std::string_view>> names;
    for (const MeshFeature& row : mesh_features())
        EXPECT_TRUE(names.emplace(row.kind, row.name).second) << row.name << " has two rows";
}

TEST(MeshFeatures, illumination_models_of_glass_and_mirrors) {
    const auto transmission = [](const std::string& fields) {
        MtlLibrary library{.folder = "gone", .budget = {}, .materials = {}, .textures = {}};
        Mesh mesh;
        MeshNotes notes;
        read_mtl("newmtl a\n" + fields, library, mesh, notes);
        return std::pair(mesh.materials.at(0).transmission, !notes.empty());
    };
    for (const char* glass : {"illum 6\n", "illum 7\n", "illum 9\nNi 1.5\n", "illum 4\nNi 1.5\n"})
        EXPECT_EQ(transmission(glass), std::pair(1.0f, false)) << glass;
    for (const char* opaque : {"illum 1\n", "illum 2\n", "illum 4\nNi 1.0\n", "illum 9\n", "illum 3\nPm 1\n"})
        EXPECT_EQ(transmission(opaque), std::pair(0.0f, false)) << opaque;
    for (const char* noted : {"illum 0\n", "illum 3\n", "illum 5\n", "illum 8\n", "illum 10\n", "illum 77\n"})
        EXPECT_EQ(transmission(noted), std::pair(0.0f, true)) << noted;
}

TEST(MeshFeatures, unlit_is_diffuse_and_not_metal) {
    File file = gltf_builder::square();
    file.root["meshes"][0]["primitives"][0]["material"] = 0;
    file.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0, 1, 0, 1}}}},
                               {"emissiveFactor", {1, 1, 1}},
                               {"extensions", {{"KHR_materials_unlit", json::object()}}}}};
    MeshNotes notes;
    const std::string bytes = file.gltf();
    const Mesh mesh = load_gltf(std::as_bytes(std::span(bytes)), "", {}, notes);
    EXPECT_EQ(mesh.materials.at(0).metallic, 0.0f);
    EXPECT_EQ(mesh.materials.at(0).emissive, glm::vec3(0.0f)) << "only the base colour counts";
    EXPECT_EQ(note_lines(notes),
              std::vector<std::string>{"KHR_materials_unlit is read as a diffuse surface"});
}

// Two instances, one turned by 180 degrees about z and scaled by 2: (1, 1, 0) goes to (-2, -2, 0) + (5, 0,
// 0).
TEST(MeshFeatures, instances_are_placed_by_translation_rotation_and_scale) {
    File file = gltf_builder::square();
    file.root["nodes"][0]["translation"] = {100, 0, 0};
    file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", file.floats({0, 0, 0, 5, 0, 0}, 3)},
        {"ROTATION", file.floats({0, 0, 0, 1, 0, 0, 1, 0}, 4)},
        {"SCALE", file.floats({1, 1, 1, 2, 2, 2}, 3)}};
    MeshNotes notes;
    const auto mesh_of = [&](const File& f) {
        const std::string bytes = f.gltf();
        return load_gltf(std::as_bytes(std::span(bytes)), "", {}, notes);
    };
    const Mesh mesh = mesh_of(file);
    ASSERT_EQ(mesh.triangles.size(), 4u);
    EXPECT_EQ(mesh.positions.at(mesh.triangles[0].vertices.z), glm::dvec3(101, 1, 0));
    EXPECT_LT(glm::distance(mesh.positions.at(mesh.triangles[2].vertices.z), glm::dvec3(103, -2, 0)), 1e-6);
    EXPECT_TRUE(notes.empty());
    json& list = file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    list["SCALE"] = file.floats({1, 1, 1}, 3);
    EXPECT_TRUE(holds(load(file).refusal, "SCALE has 1 elements, another attribute 2"));
    list["SCALE"] = file.floats({1, 1, 1, 1}, 2);
    EXPECT_TRUE(holds(load(file).refusal, "SCALE has elements of 2 numbers, not 3"));
    list["SCALE"] = 99;
    EXPECT_TRUE(holds(load(file).refusal, "names accessors[99]"));
}

// A mirror turns triangles round; the reader turns them back, so that normals still point out.
TEST(MeshFeatures, mirrored_nodes_keep_their_outer_side) {
    File file = gltf_builder::square();
    const auto normal = [&] {
        MeshNotes notes;
        const std::string bytes = file.gltf();
        const Mesh mesh = load_gltf(std::as_bytes(std::span(bytes)), "", {}, notes);
        const glm::uvec3 v = mesh.triangles.at(0).vertices;
        return glm::cross(mesh.positions[v.y] - mesh.positions[v.x],
                          mesh.positions[v.z] - mesh.positions[v.x]);
    };
    EXPECT_GT(normal().z, 0.0);
    file.root["nodes"][0]["scale"] = {-1, 1, 1};
    EXPECT_GT(normal().z, 0.0);
    file.root["nodes"][0]["scale"] = {1, 1, -1};
    EXPECT_LT(normal().z, 0.0);
}

TEST(MeshFeatures, animation_of_nodes_is_noted) {
    File file = gltf_builder::square();
    const auto animate = [&](const char* path) {
        file.root["animations"] = {{{"channels", {{{"target", {{"node", 0}, {"path", path}}}}}}}};
        return load(file).notes;
    };
    EXPECT_EQ(animate("rotation"), "an animation is ignored: the mesh is read in its rest pose\n");
    EXPECT_EQ(animate("weights"), "");
    file.root["animations"] = {1, {{"channels", 3}}, {{"channels", {json::object(), {{"target", 1}}}}}};
    EXPECT_EQ(load(file).refusal, "");
}

// Every place where a word of the file gets into a message.
TEST(HostileNames, of_meshes_are_escaped_and_cut) {
    const std::vector<std::string> hostile = {"\x1b]0;pwned\x07", "\xff\xfe", "\x9b[2J",
                                              std::string(100000, 'x')};
    for (const std::string& name : hostile) {
        std::vector<Loaded> results = {load_object("usemtl " + name + "\n"),
                                       load_object("mtllib " + name + "\n"),
                                       load_object("f " + name + " 1 2\n"),
                                       load_object(name + "\n"),
                                       load_object("v " + name + " 0 0\n"),
                                       load_materials("map_Kd " + name + "\n"),
                                       load_materials("map_Kd -" + name + " 1 a.png\n"),
                                       load_materials(name + " 1\n"),
                                       load_materials("Ns " + name + "\n")};
        if (name[0] == '\x1b' || name[0] == 'x') {  // JSON is UTF-8
            const auto with = [&](const std::function<void(json&)>& tell) {
                File file = gltf_builder::textured_square();
                tell(file.root);
                results.push_back(load(file));
            };
            with([&](json& r) { r["materials"][0]["extensions"][name] = json::object(); });
            with([&](json& r) { r["extensionsRequired"] = {name}; });
            with([&](json& r) { r["asset"]["version"] = name; });
            with([&](json& r) { r["images"][0] = {{"uri", name}}; });
            with([&](json& r) {
                r["images"][0]["name"] = name;
                r["images"][0]["bufferView"] = 0;
            });
            with([&](json& r) { r["buffers"] = {{{"byteLength", 9}, {"uri", name}}}; });
            with([&](json& r) {
                r["scenes"][0]["name"] = name;
                r["scene"] = 9;
            });
        }
        for (const Loaded& result : results) {
            const std::string text = result.notes + result.refusal;
            EXPECT_FALSE(text.empty());
            EXPECT_LT(text.size(), 700u);
            for (const char c : text)
                EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << static_cast<int>(c) << " in " << text;
        }
    }
}

}  // namespace
}  // namespace voxilux
