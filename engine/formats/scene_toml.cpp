#include "formats/scene_toml.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <memory>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "formats/sky_image.h"
#include "formats/toml_scene.h"
#include "formats/vox_objects.h"
#include "formats/vox_read.h"
#include "scene/animation.h"
#include "scene/vox_file.h"
#include "scene/vox_scene.h"
#include "scene/vox_settings.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxTomlBytes = std::size_t{16} << 20;  // what a person writes is a thousandth of it

constexpr int kMaxDottedKeys = 32, kMaxBrackets = 32;

// The library copies and destroys tables recursively, and each dot of a key makes a table: text that would
// nest deeper than any scene is refused before it is parsed. Dots are counted from one delimiter to the next,
// also those in comments and strings.
void check_nesting(std::string_view text, const std::string& path) {
    int dots = 0, brackets = 0;
    char before = '\n';
    for (const char c : text) {
        if (c == '.') dots = before == '.' ? 0 : dots + 1;
        if (c == '=' || c == ',' || c == '\n') dots = 0;
        if (c == '[' || c == '{') ++brackets;
        if (c == ']' || c == '}') --brackets;
        if (dots > kMaxDottedKeys || brackets > kMaxBrackets)
            throw Error(ExitCode::input_refused,
                        fmt::format("{}: nested deeper than {} levels", path, kMaxDottedKeys));
        before = c;
    }
}

toml::table parse_toml(std::string_view text, const std::string& path) {
    check_nesting(text, path);
    try {
        return toml::parse(text, path);
    } catch (const toml::parse_error& error) {
        refuse_at(error.source(), std::string(error.description()));
    }
}

// The tree of one -D option. A value that is not TOML is taken as a string, so that -D render.sequence=white
// needs no quotes.
toml::table parse_override(const std::string& option) {
    const std::string path = "-D " + option;
    const std::size_t equals = option.find('=');
    if (equals == std::string::npos || equals == 0)
        refuse_at({{}, {}, std::make_shared<const std::string>(path)},
                  "must be key=value, for example sun.elevation=10");
    const std::string key = option.substr(0, equals), value = option.substr(equals + 1);
    check_nesting(key + " = " + value, path);
    try {
        return toml::parse(key + " = " + value, path);
    } catch (const toml::parse_error&) {
        std::string quoted;
        for (const char c : value)
            quoted += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
        return parse_toml(key + " = \"" + quoted + "\"", path);
    }
}

void merge(toml::table& into, toml::table& from);

// Puts `value` at `place`, a key of a table or a position in a list. It is moved, and so keeps its source.
template <class Container, class Place>
void put(Container& into, const Place& place, toml::node& value) {
    value.visit([&](auto& node) {
        if constexpr (std::is_same_v<Container, toml::array>)
            into.replace(into.cbegin() + place, std::move(node));
        else
            into.insert_or_assign(place, std::move(node));
    });
}

// "sphere.0.radius": the keys of `from` are positions in the list.
void merge_into_list(toml::array& into, toml::table& from) {
    for (auto&& [key, value] : from) {
        std::size_t index = 0;
        const std::string_view text = key.str();
        const auto parsed = std::from_chars(text.data(), text.data() + text.size(), index);
        if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || index >= into.size())
            refuse_at(value.source(),
                      fmt::format("'{}' is no position in a list of {} (the first is 0)", text, into.size()));
        toml::node& old = into[index];
        if (old.is_table() && value.is_table())
            merge(*old.as_table(), *value.as_table());
        else
            put(into, static_cast<std::ptrdiff_t>(index), value);
    }
}

void merge(toml::table& into, toml::table& from) {
    for (auto&& [key, value] : from) {
        toml::node* old = into.get(key);
        if (old != nullptr && old->is_table() && value.is_table())
            merge(*old->as_table(), *value.as_table());
        else if (old != nullptr && old->is_array() && value.is_table())
            merge_into_list(*old->as_array(), *value.as_table());
        else
            put(into, key, value);
    }
}

// The image of the sky, for scenes that have one. A .vox file may have brought it already.
void read_sky_image(TomlScene& in) {
    Sky& sky = in.scene.sky;
    const toml::table* table = find_section(in, "sky");
    const toml::node* file = table != nullptr ? table->get("image") : nullptr;
    if (file != nullptr && !table->contains("model")) sky.model = SkyModel::image;
    if (!sky.is_image()) {
        sky.image = {};
        return;
    }
    if (file == nullptr && sky.image.texels.empty())
        refuse_at(table->source(), "[sky] with the model 'image' needs 'image', the name of a file");
    if (file == nullptr) return;
    try {
        sky.image = load_sky_image(in.folder / sky.image_file, in.scene.warnings);
    } catch (const Error& error) {
        if (error.code() != ExitCode::input_refused) throw;
        refuse_at(file->source(), fmt::format("'image' in [sky] cannot be used: {}", error.what()));
    }
}

void read_tree(toml::table& root, const std::filesystem::path& file, const LoadOptions& options,
               Scene& scene) {
    for (const std::string& option : options.overrides) {
        toml::table tree = parse_override(option);
        merge(root, tree);
    }
    const TomlSection sections(root, "the scene",
                               {"render", "ao", "photons", "paths", "technique", "camera", "sun", "sky",
                                "background", "ground", "material", "model", "shape", "sphere"});
    TomlScene in{.root = root, .folder = file.parent_path(), .frame = options.frame, .scene = scene};
    visit_sections(scene, [&](std::string_view name, auto& settings) {
        if (const toml::table* table = find_section(in, name))
            (void)read_settings(*table, fmt::format("[{}]", name), settings);
    });
    read_sky_image(in);
    read_technique(in);
    read_materials(in);
    read_models(in);
    read_shapes(in);
    read_spheres(in);
    if (const toml::table* ground = find_section(in, "ground"); ground != nullptr && !ground->contains("on"))
        scene.ground.on = true;
    const toml::table* background = find_section(in, "background");
    const bool has_colour =
        background != nullptr && (background->contains("color") || background->contains("radiance"));
    if (has_colour && !background->contains("shown")) scene.background.shown = Backdrop::color;
    if (scene.ground.on && !scene.ground.height) scene.ground.height = bounds_of_frames(scene).lo.z;
    read_camera(in);
}

void end_step(const LoadOptions& options, const char* label) {
    if (options.times != nullptr) options.times->end_step(label);
}

// The image that the settings of a .vox file name is used where a file of that name is beside it.
void load_vox_sky(const std::filesystem::path& file, Scene& scene) {
    Sky& sky = scene.sky;
    if (!sky.is_image()) return;
    try {
        sky.image = load_sky_image(file.parent_path() / sky.image_file, scene.warnings);
    } catch (const Error& error) {
        if (error.code() != ExitCode::input_refused) throw;
        sky = Sky{};
        scene.notes.push_back(
            fmt::format("the image of the sky cannot be used, and our sky is shown: {}", error.what()));
    }
}

std::string lower_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

}  // namespace

const toml::table* find_section(const TomlScene& in, std::string_view name) {
    const toml::node* node = in.root.get(name);
    if (node == nullptr) return nullptr;
    if (!node->is_table()) refuse_at(node->source(), fmt::format("'{}' must be a section [{}]", name, name));
    return node->as_table();
}

std::vector<const toml::table*> find_sections(const TomlScene& in, std::string_view name) {
    std::vector<const toml::table*> tables;
    const toml::node* node = in.root.get(name);
    if (node == nullptr) return tables;
    const auto refuse = [&](const toml::node& at) {
        refuse_at(at.source(), fmt::format("'{}' must be sections [[{}]] in double brackets", name, name));
    };
    if (!node->is_array()) refuse(*node);
    for (const toml::node& element : *node->as_array()) {
        if (!element.is_table()) refuse(element);
        tables.push_back(element.as_table());
    }
    return tables;
}

Scene parse_scene(std::string_view text, const std::filesystem::path& file, const LoadOptions& options) {
    toml::table root = parse_toml(text, file.string());
    Scene scene;
    read_tree(root, file, options, scene);
    end_step(options, "scene");
    return scene;
}

Scene scene_of_file(const VoxFile& vox, const std::filesystem::path& file, const LoadOptions& options) {
    Scene scene;
    place_vox(scene, add_vox(scene, vox, options.frame), Rotation{}, glm::ivec3(0));
    if (!options.ignores_file_settings) {
        apply_vox_settings(vox, render_objects(vox), scene);
        load_vox_sky(file, scene);
    }
    toml::table root;
    read_tree(root, file, options, scene);
    end_step(options, "scene");
    return scene;
}

Scene load_scene(const std::filesystem::path& file, const LoadOptions& options) {
    const std::string extension = lower_extension(file);
    if (extension == ".vox") {
        const VoxFile vox = load_vox(file);
        end_step(options, "read");
        return scene_of_file(vox, file, options);
    }
    if (extension != ".toml")
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: unknown kind of scene; give a .vox or a .toml file", file.string()));
    const std::vector<std::byte> bytes = read_file(file, kMaxTomlBytes);
    return parse_scene({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file, options);
}

}  // namespace voxilux
