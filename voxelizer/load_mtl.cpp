#include "voxelizer/load_mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/checked_cast.h"
#include "base/error.h"
#include "base/file.h"
#include "voxelizer/mesh_uri.h"
#include "voxelizer/obj_text.h"

namespace voxilux {
namespace {

// A texture as a map_ line names it.
struct MapLine {
    std::string file;
    glm::dvec2 scale{1.0};
    glm::dvec2 offset{0.0};
    bool is_clamped = false;
};

struct Entry {
    MeshMaterial material{.metallic = 0.0f};
    std::optional<MapLine> base_color, emissive, alpha;
    std::optional<double> opacity, transparency, roughness, shine;
    int illumination = 0;
};

float unit(double value) {
    return std::isfinite(value) ? static_cast<float>(std::clamp(value, 0.0, 1.0)) : 1.0f;
}

// Up to three numbers; what follows a lone first one counts as equal to it.
glm::dvec3 read_rgb(ObjLines& lines) {
    const double r = lines.require_number();
    const double g = lines.next_number().value_or(r);
    return {r, g, lines.next_number().value_or(g)};
}

// -o and -s take one to three numbers; the others as many words as the table says.
void skip_option(ObjLines& lines, std::string_view option) {
    constexpr std::pair<std::string_view, int> kWords[] = {{"-mm", 2}, {"-t", 3}};
    const auto* const found = std::ranges::find(kWords, option, &std::pair<std::string_view, int>::first);
    for (int i = 0; i < (found == std::end(kWords) ? 1 : found->second); ++i)
        (void)lines.next_word();
}

glm::dvec2 read_pair(ObjLines& lines, double fallback) {
    glm::dvec3 values(fallback);
    for (int i = 0; i < 3; ++i) {
        const auto number = number_in(lines.peek_word());
        if (!number) break;
        values[i] = std::isfinite(*number) ? *number : fallback;
        (void)lines.next_word();
    }
    return {values.x, values.y};
}

MapLine read_map(ObjLines& lines) {
    MapLine map;
    while (lines.rest().starts_with('-')) {
        const std::string option(lines.next_word());
        if (option == "-s")
            map.scale = read_pair(lines, 1.0);
        else if (option == "-o")
            map.offset = read_pair(lines, 0.0);
        else if (option == "-clamp")
            map.is_clamped = lines.next_word() == "on";
        else
            skip_option(lines, option);
    }
    map.file = lines.rest();
    return map;
}

void read_field(ObjLines& lines, Entry& entry) {
    MeshMaterial& material = entry.material;
    const std::string key(lines.next_word());
    if (key == "Kd") {
        const glm::dvec3 rgb = number_in(lines.peek_word()) ? read_rgb(lines) : glm::dvec3(1.0);
        material.base_color = glm::vec4(unit(rgb.r), unit(rgb.g), unit(rgb.b), 1.0f);
    } else if (key == "Ke") {
        constexpr double kBrightest = 1e6;  // keeps sums of many texels finite in floats
        const glm::dvec3 rgb = read_rgb(lines);
        for (int i = 0; i < 3; ++i)
            material.emissive[i] =
                std::isfinite(rgb[i]) ? static_cast<float>(std::clamp(rgb[i], 0.0, kBrightest)) : 0.0f;
    } else if (key == "d") {
        if (lines.rest().starts_with("-halo")) (void)lines.next_word();
        entry.opacity = lines.require_number();
    } else if (key == "Tr") {
        entry.transparency = lines.require_number();
    } else if (key == "Ns") {
        entry.shine = lines.require_number();
    } else if (key == "Ni") {
        const double ior = lines.require_number();
        if (ior >= 1.0) material.ior = static_cast<float>(std::min(ior, 10.0));
    } else if (key == "Pm") {
        material.metallic = unit(lines.require_number());
    } else if (key == "Pr") {
        entry.roughness = lines.require_number();
    } else if (key == "illum") {
        entry.illumination = static_cast<int>(std::clamp(lines.require_number(), 0.0, 10.0));
    } else if (key == "map_Kd") {
        entry.base_color = read_map(lines);
    } else if (key == "map_Ke") {
        entry.emissive = read_map(lines);
    } else if (key == "map_d") {
        entry.alpha = read_map(lines);
    }
}

std::optional<std::uint32_t> add_texture(const MapLine& map, MtlLibrary& library, Mesh& mesh,
                                         MeshNotes& notes) {
    try {
        const auto bytes = read_file(find_beside(library.folder, map.file), library.budget.limits.file_bytes);
        Texture texture = decode_texture(bytes, map.file, library.budget);
        texture.wrap_u = texture.wrap_v = map.is_clamped ? TextureWrap::clamp_to_edge : TextureWrap::repeat;
        mesh.textures.push_back(std::move(texture));
        return checked_cast<std::uint32_t>(mesh.textures.size() - 1, "textures");
    } catch (const MeshFault& fault) {
        ++notes[fmt::format("a texture is left out: {}", fault.what())];
    } catch (const Error& error) {
        ++notes[fmt::format("a texture is left out: {}", error.what())];
    }
    return std::nullopt;
}

std::optional<TextureUse> texture_use(const std::optional<MapLine>& map, MtlLibrary& library, Mesh& mesh,
                                      MeshNotes& notes) {
    if (!map) return std::nullopt;
    const auto [found, is_new] =
        library.textures.try_emplace((map->is_clamped ? "clamp " : "repeat ") + map->file);
    if (is_new) found->second = add_texture(*map, library, mesh, notes);
    if (!found->second) return std::nullopt;
    // Meshes hold 1 - v, because rows of a texture go down and v goes up: (s v + o) becomes 1 - (s (1 - v) +
    // o).
    TextureUse use{.texture = *found->second};
    use.transform = {glm::dvec3(map->scale.x, 0.0, 0.0), glm::dvec3(0.0, map->scale.y, 0.0),
                     glm::dvec3(map->offset.x, 1.0 - map->scale.y - map->offset.y, 1.0)};
    return use;
}

// What depends on several fields, whatever their order.
MeshMaterial finish(Entry& entry, MtlLibrary& library, Mesh& mesh, MeshNotes& notes) {
    MeshMaterial& material = entry.material;
    material.base_color.a = unit(entry.opacity.value_or(1.0 - entry.transparency.value_or(0.0)));
    if (material.base_color.a < 1.0f) material.alpha_mode = AlphaMode::blend;
    // A Phong exponent s is about as wide as the microfacet roughness sqrt(2 / (s + 2)). Source: Walter et
    // al., Microfacet models for refraction through rough surfaces, EGSR 2007, section 5.2.
    const double shine = entry.shine && *entry.shine > 0.0 ? *entry.shine : 0.0;
    material.roughness = unit(entry.roughness.value_or(std::sqrt(2.0 / (shine + 2.0))));
    if (entry.illumination == 6 || entry.illumination == 7) material.transmission = 1.0f;  // refraction
    material.base_color_texture = texture_use(entry.base_color, library, mesh, notes);
    if (material.emissive != glm::vec3(0.0f))
        material.emissive_texture = texture_use(entry.emissive, library, mesh, notes);
    if (entry.alpha && entry.base_color && entry.alpha->file == entry.base_color->file)
        material.alpha_mode = AlphaMode::mask;
    else if (entry.alpha)
        ++notes["map_d is ignored: it is another picture than map_Kd"];
    return material;
}

void add_material(Entry& entry, MtlLibrary& library, Mesh& mesh, MeshNotes& notes) {
    const auto index = checked_cast<std::uint32_t>(mesh.materials.size(), "materials");
    if (!library.materials.emplace(entry.material.name, index).second) {
        ++notes["a material is left out: its name is taken"];
        return;
    }
    mesh.materials.push_back(finish(entry, library, mesh, notes));
}

std::vector<std::byte> read_library(const std::string& name, const MtlLibrary& library, MeshNotes& notes) {
    try {
        return read_file(find_beside(library.folder, name), library.budget.limits.file_bytes);
    } catch (const MeshFault& fault) {
        ++notes[fmt::format("materials are left out: {}", fault.what())];
    } catch (const Error& error) {
        ++notes[fmt::format("materials are left out: {}", error.what())];
    }
    return {};
}

}  // namespace

void read_mtl(std::string_view text, MtlLibrary& library, Mesh& mesh, MeshNotes& notes) {
    ObjLines lines(text);
    std::optional<Entry> entry;
    while (lines.next_line()) {
        if (lines.peek_word() == "newmtl") {
            (void)lines.next_word();
            if (entry) add_material(*entry, library, mesh, notes);
            entry.emplace();
            entry->material.name = lines.rest();
        } else if (entry) {
            read_field(lines, *entry);
        }
    }
    if (entry) add_material(*entry, library, mesh, notes);
}

void load_mtl(const std::string& name, MtlLibrary& library, Mesh& mesh, MeshNotes& notes) {
    const std::vector<std::byte> bytes = read_library(name, library, notes);
    try {
        read_mtl({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, library, mesh, notes);
    } catch (const MeshFault& fault) {
        throw MeshFault(fmt::format("{}: {}", quoted_name(name), fault.what()));
    }
}

std::filesystem::path find_beside(const std::filesystem::path& folder, const std::string& name) {
    std::string path = name;
    std::ranges::replace(path, '\\', '/');
    std::error_code ignored;
    try {
        const std::filesystem::path inside = path_inside(folder, path);
        if (std::filesystem::exists(inside, ignored)) return inside;
    } catch (const MeshFault&) {
        // Of another machine, or out of the folder: only its last name counts.
    }
    return path_inside(folder, path.substr(path.find_last_of('/') + 1));
}

}  // namespace voxilux
