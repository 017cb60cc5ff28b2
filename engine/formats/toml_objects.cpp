// The named and repeated sections: [material.NAME], [[model]], [[sphere]].

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/nearest_name.h"
#include "formats/toml_scene.h"
#include "formats/vox_read.h"
#include "scene/vox_file.h"
#include "scene/vox_scene.h"

namespace voxilux {
namespace {

constexpr Range kTranslation{-kVoxMaxTranslation, kVoxMaxTranslation};

// What follows from the surface, once every row has been read.
void settle_surface(const TomlSection& section, Material& material) {
    const bool glows = material.emission != glm::vec3(0.0f);
    if (!section.has("surface") && glows) material.surface = Surface::emit;
    if (material.surface == Surface::emit && !glows)
        section.refuse("surface", "is \"emit\", which needs 'emission' above zero");
    material.metallic = material.surface == Surface::metal ? 1.0f : 0.0f;
    material.transmission = material.surface == Surface::glass ? 1.0f : 0.0f;
    const bool is_polished = material.metallic + material.transmission > 0.0f;
    if (is_polished && !section.has("roughness")) material.roughness = 0.0f;
}

// The signed permutation of one word of `rotate`: the right-handed turn about the axis "x", "y" or "z" by 90,
// 180 or 270 degrees.
Rotation turn(const TomlSection& section, const std::string& word) {
    const std::string_view axes = "xyz";
    const std::size_t k = word.empty() ? std::string_view::npos : axes.find(word.front());
    const std::string_view angle = std::string_view(word).substr(std::min<std::size_t>(1, word.size()));
    const int quarters = angle == "90" ? 1 : angle == "180" ? 2 : angle == "270" ? 3 : 0;
    if (k == std::string_view::npos || quarters == 0)
        section.refuse(
            "rotate", fmt::format("must be of \"x90\", \"x180\", \"x270\", \"y90\", ... \"z270\", not \"{}\"",
                                  word.substr(0, 40)));
    // A quarter turn about axis k takes axis i to j: result j is v[i], result i is -v[j].
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    Rotation quarter;
    quarter.axis[j] = static_cast<std::uint8_t>(i);
    quarter.axis[i] = static_cast<std::uint8_t>(j);
    quarter.sign[i] = -1;
    Rotation result;
    for (int q = 0; q < quarters; ++q)
        result = quarter.after(result);
    return result;
}

Rotation read_rotation(const TomlSection& section) {
    Rotation rotation;
    for (const std::string& word : section.texts("rotate").value_or(std::vector<std::string>{}))
        rotation = turn(section, word).after(rotation);
    for (const std::string& word : section.texts("mirror").value_or(std::vector<std::string>{})) {
        if (word != "x" && word != "y" && word != "z")
            section.refuse("mirror",
                           fmt::format("must be of \"x\", \"y\", \"z\", not \"{}\"", word.substr(0, 40)));
        Rotation mirror;
        mirror.sign[static_cast<std::size_t>(word.front() - 'x')] = -1;
        rotation = mirror.after(rotation);
    }
    return rotation;
}

// What each file has added to the scene, by its own frame or (none) animated with the scene: a file that is
// placed often is read and kept once.
using AddedFiles = std::map<std::pair<std::filesystem::path, std::optional<std::int64_t>>, AddedVox>;

AddedVox add_file(TomlScene& in, const std::filesystem::path& path, std::optional<std::int64_t> frame) {
    const VoxFile file = load_vox(path);
    if (frame) return {.instances = add_vox_models(in.scene, file, static_cast<int>(*frame))};
    return add_vox(in.scene, file, in.frame);
}

void read_model(TomlScene& in, const toml::table& table, AddedFiles& added) {
    const TomlSection section(table, "[[model]]", {"file", "translate", "rotate", "mirror", "frame"});
    const std::filesystem::path path = in.folder / section.require(section.get<std::string>("file"), "file");
    const auto translate = section.get<glm::ivec3>("translate", kTranslation);
    const Rotation rotation = read_rotation(section);
    const auto frame = section.get<std::int64_t>("frame", {0, kMaxFrame});
    try {
        auto known = added.find({path, frame});
        if (known == added.end())
            known = added.emplace(std::pair(path, frame), add_file(in, path, frame)).first;
        place_vox(in.scene, known->second, rotation, translate.value_or(glm::ivec3(0)));
    } catch (const Error& error) {
        if (error.code() != ExitCode::input_refused) throw;
        section.refuse("file", fmt::format("cannot be used: {}", error.what()));
    }
}

}  // namespace

void read_materials(TomlScene& in) {
    const toml::table* all = find_section(in, "material");
    if (all == nullptr) return;
    for (const auto& [key, value] : *all) {
        const std::string name(key.str());
        if (!value.is_table())
            refuse_at(value.source(),
                      fmt::format("'{}' in [material] must be a section [material.{}]", name, name));
        Material material{.name = name};
        const TomlSection section =
            read_settings(*value.as_table(), fmt::format("[material.{}]", name), material);
        if (name == kAir) section.refuse("has the name of what carves: choose another name");
        if (in.scene.materials.size() >= kMaxMaterials)
            section.refuse(fmt::format("is one material too many: at most {}", kMaxMaterials));
        in.materials[name] = static_cast<std::uint32_t>(in.scene.materials.size());
        settle_surface(section, material);
        in.scene.materials.push_back(std::move(material));
    }
}

std::uint32_t find_material(const TomlScene& in, const TomlSection& section, std::string_view key,
                            const std::string& name) {
    const auto found = in.materials.find(name);
    if (found != in.materials.end()) return found->second;
    std::vector<std::string_view> names;
    for (const auto& [known, index] : in.materials)
        names.push_back(known);
    section.refuse(
        key, fmt::format("names the unknown material '{}'{}", name.substr(0, 40), name_hint(name, names)));
}

void read_models(TomlScene& in) {
    AddedFiles added;
    for (const toml::table* table : find_sections(in, "model"))
        read_model(in, *table, added);
}

void read_spheres(TomlScene& in) {
    for (const toml::table* table : find_sections(in, "sphere")) {
        Sphere sphere;
        const TomlSection section = read_settings(*table, "[[sphere]]", sphere, {"material"});
        const std::string name = section.require(section.get<std::string>("material"), "material");
        sphere.material = find_material(in, section, "material", name);
        in.scene.spheres.push_back(sphere);
    }
}

}  // namespace voxilux
