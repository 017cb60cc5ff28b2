#include "voxelizer/load_mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/checked_cast.h"
#include "base/error.h"
#include "base/file.h"
#include "base/printable.h"
#include "voxelizer/mesh_features.h"
#include "voxelizer/mesh_uri.h"
#include "voxelizer/obj_text.h"
#include "voxelizer/surface_look.h"

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
    std::optional<glm::dvec3> emission, filter;
    std::optional<MapLine> base_color, emissive, alpha;
    std::optional<double> opacity, transparency, roughness, shine, ior;
    double illumination = 2.0;
    bool has_metallic = false;
};

// What the parsing of a line needs.
struct MtlLine {
    ObjLines& lines;
    std::string key;
    MeshNotes& notes;
};

float unit(double value) {
    return std::isfinite(value) ? static_cast<float>(std::clamp(value, 0.0, 1.0)) : 1.0f;
}

// Up to three numbers; missing ones equal the first. Nothing, and a note, for colours in other terms
// (spectral, xyz).
std::optional<glm::dvec3> read_rgb(const MtlLine& line) {
    ObjLines& lines = line.lines;
    const std::string_view first = lines.peek_word();
    if (first == "spectral" || first == "xyz") {
        ++line.notes[fmt::format("{} is left out: it is not in red, green and blue", line.key)];
        return std::nullopt;
    }
    const double r = lines.require_number();
    const double g = lines.next_number().value_or(r);
    return glm::dvec3(r, g, lines.next_number().value_or(g));
}

glm::vec3 unit(const glm::dvec3& rgb) {
    return {unit(rgb.r), unit(rgb.g), unit(rgb.b)};
}

// Whether the words change nothing: only zeros, "off", or the identity of -mm.
bool is_neutral(const std::vector<std::string_view>& words, std::string_view key) {
    if (key == "-mm" && words.size() == 2) return number_in(words[0]) == 0.0 && number_in(words[1]) == 1.0;
    return !words.empty() && std::ranges::all_of(words, [](std::string_view word) {
        return word == "off" || number_in(word) == 0.0;
    });
}

// -o, -s and -t take one to three numbers, -mm two, the others one word.
void skip_option(const MtlLine& line, const std::string& option) {
    ObjLines& lines = line.lines;
    std::vector<std::string_view> words;
    const std::size_t most = option == "-t" ? 3 : option == "-mm" ? 2 : 1;
    while (words.size() < most && !lines.rest().empty() && (words.empty() || number_in(lines.peek_word())))
        words.push_back(lines.next_word());
    if (!is_neutral(words, option)) note_feature(FeatureKind::mtl_map_option, option, line.notes);
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

MapLine read_map(const MtlLine& line) {
    ObjLines& lines = line.lines;
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
            skip_option(line, option);
    }
    map.file = lines.rest();
    return map;
}

double read_opacity(const MtlLine& line) {
    if (line.lines.peek_word() == "-halo") {
        (void)line.lines.next_word();
        ++line.notes["-halo is left out: d counts from all sides alike"];
    }
    return line.lines.require_number();
}

// Skips a keyword that is not read; a line that changes nothing needs no note.
void skip_field(const MtlLine& line) {
    std::vector<std::string_view> words;
    while (!line.lines.rest().empty())
        words.push_back(line.lines.next_word());
    if (!is_neutral(words, line.key)) note_feature(FeatureKind::mtl_keyword, line.key, line.notes);
}

bool read_map_field(const MtlLine& line, Entry& entry) {
    if (line.key == "map_Kd")
        entry.base_color = read_map(line);
    else if (line.key == "map_Ke")
        entry.emissive = read_map(line);
    else if (line.key == "map_d")
        entry.alpha = read_map(line);
    else
        return false;
    return true;
}

void read_field(const MtlLine& line, Entry& entry) {
    MeshMaterial& material = entry.material;
    const std::string& key = line.key;
    if (key == "Kd") {
        material.base_color = glm::vec4(unit(read_rgb(line).value_or(glm::dvec3(1.0))), 1.0f);
    } else if (key == "Ke") {
        entry.emission = read_rgb(line).value_or(glm::dvec3(0.0));
    } else if (key == "Tf") {
        entry.filter = read_rgb(line);
    } else if (key == "d") {
        entry.opacity = read_opacity(line);
    } else if (key == "Tr") {
        entry.transparency = line.lines.require_number();
    } else if (key == "Ns") {
        entry.shine = line.lines.require_number();
    } else if (key == "Ni") {
        entry.ior = line.lines.require_number();
    } else if (key == "Pm") {
        material.metallic = unit(line.lines.require_number());
        entry.has_metallic = true;
    } else if (key == "Pr") {
        entry.roughness = line.lines.require_number();
    } else if (key == "illum") {
        entry.illumination = line.lines.require_number();
    } else if (!read_map_field(line, entry)) {
        skip_field(line);
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

// Whether the illumination model is one of glass; notes models that are not supported. 4 and 9 count as glass
// only with a refractive index: writers also use them for opaque materials, without one or with that of air.
bool is_glass(const Entry& entry, MeshNotes& notes) {
    const double model = entry.illumination;
    if (model == 6.0 || model == 7.0) return true;
    if (model == 4.0 || model == 9.0) return entry.ior.value_or(1.0) > 1.0;
    const bool is_mirror = model == 3.0 || model == 5.0 || model == 8.0;
    const bool is_plain = model == 1.0 || model == 2.0;
    if (!is_plain && !(is_mirror && entry.has_metallic))
        ++notes[fmt::format("illum {} is read as a diffuse surface", model)];
    return false;
}

void finish_glass(const Entry& entry, MeshMaterial& material, MeshNotes& notes) {
    material.transmission = 1.0f;
    if (entry.filter && *entry.filter != glm::dvec3(0.0))
        material.base_color = glm::vec4(unit(*entry.filter), material.base_color.a);
    // The format does not scatter refracted light; a highlight width, where given, applies to both.
    if (!entry.roughness && !entry.shine) material.roughness = 0.0f;
    if (entry.base_color && entry.filter) ++notes["map_Kd is read as the filter colour of glass"];
}

void finish_emission(const Entry& entry, MtlLibrary& library, Mesh& mesh, MeshMaterial& material,
                     MeshNotes& notes) {
    // A texture without a factor is used unchanged.
    const glm::dvec3 fallback(entry.emissive ? 1.0 : 0.0);
    material.emissive = emission_in_range(entry.emission.value_or(fallback), notes);
    if (material.emissive != glm::vec3(0.0f))
        material.emissive_texture = texture_use(entry.emissive, library, mesh, notes);
    else if (entry.emissive)
        ++notes["map_Ke is left out: its factor Ke is 0"];
}

void finish_alpha(const Entry& entry, MeshMaterial& material, MeshNotes& notes) {
    if (entry.alpha && entry.base_color && entry.alpha->file == entry.base_color->file)
        material.alpha_mode = AlphaMode::mask;
    else if (entry.alpha)
        ++notes["map_d is ignored: it is not the image of map_Kd"];
}

// Evaluates what depends on several fields, whatever their order.
MeshMaterial finish(Entry& entry, MtlLibrary& library, Mesh& mesh, MeshNotes& notes) {
    MeshMaterial& material = entry.material;
    material.base_color.a = unit(entry.opacity.value_or(1.0 - entry.transparency.value_or(0.0)));
    if (material.base_color.a < 1.0f) material.alpha_mode = AlphaMode::blend;
    if (entry.ior.value_or(0.0) >= 1.0) material.ior = static_cast<float>(std::min(*entry.ior, 10.0));
    // A Phong exponent s is about as wide as the microfacet roughness sqrt(2 / (s + 2)). Source: Walter et
    // al., Microfacet models for refraction through rough surfaces, EGSR 2007, section 5.2.
    const double shine = entry.shine && *entry.shine > 0.0 ? *entry.shine : 0.0;
    material.roughness = unit(entry.roughness.value_or(std::sqrt(2.0 / (shine + 2.0))));
    if (is_glass(entry, notes))
        finish_glass(entry, material, notes);
    else if (entry.filter && *entry.filter != glm::dvec3(1.0) && *entry.filter != glm::dvec3(0.0))
        ++notes["Tf is left out: only glass filters light"];
    material.base_color_texture = texture_use(entry.base_color, library, mesh, notes);
    finish_emission(entry, library, mesh, material, notes);
    finish_alpha(entry, material, notes);
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
            read_field({lines, std::string(lines.next_word()), notes}, *entry);
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
        // A path of another machine, or out of the folder: only its last component is used.
    }
    return path_inside(folder, path.substr(path.find_last_of('/') + 1));
}

}  // namespace voxilux
