#include "formats/vox_info.h"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "base/printable.h"
#include "formats/vox_objects.h"
#include "scene/vox_graph.h"
#include "scene/vox_instances.h"
#include "scene/vox_settings.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxKinds = 64;    // distinct names of types and chunks that are listed
constexpr std::size_t kNameLength = 32;  // characters of each

// Counts of names that come from the file: printable, and no more of them than a person would read.
void count_name(std::map<std::string, std::size_t>& counts, std::string_view name) {
    std::string shown = printable(name, kNameLength);
    if (counts.size() >= kMaxKinds && !counts.contains(shown)) shown = "(others)";
    ++counts[shown];
}

void extend(std::optional<VoxBox>& box, glm::ivec3 a, glm::ivec3 b) {
    if (!box) box = {glm::min(a, b), glm::max(a, b)};
    box->first = glm::min(box->first, glm::min(a, b));
    box->second = glm::max(box->second, glm::max(a, b));
}

// Corner `p` of the grid (not a cell) under the instance.
glm::ivec3 world_corner(const VoxInstance& instance, glm::ivec3 size, glm::ivec3 p) {
    return instance.rotation.apply(p - size / 2) + instance.translation;
}

// Box of the stored voxels of a model; nothing when there are none.
std::optional<VoxBox> stored_box(const VoxModel& model) {
    std::optional<VoxBox> box;
    for (const VoxVoxel& v : model.voxels)
        extend(box, {v.x, v.y, v.z}, glm::ivec3(v.x, v.y, v.z) + 1);
    return box;
}

void measure_models(const VoxFile& file, VoxInfo& info) {
    std::array<bool, 256> used{};
    for (const VoxModel& model : file.models) {
        info.sizes.push_back(model.size);
        info.voxels += model.voxels.size();
        info.out_of_size += model.out_of_size;
        info.duplicates += model.duplicates;
        info.index0 += model.index0;
        for (const VoxVoxel& voxel : model.voxels)
            used[voxel.index] = true;
    }
    info.colours_used = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
}

void measure_instances(const VoxFile& file, const std::vector<VoxInstance>& instances, VoxInfo& info) {
    std::vector<std::optional<VoxBox>> boxes;
    for (const VoxModel& model : file.models)
        boxes.push_back(stored_box(model));
    info.instances = instances.size();
    for (const VoxInstance& instance : instances) {
        const VoxModel& model = file.models[instance.model];
        const auto corner = [&](glm::ivec3 p) { return world_corner(instance, model.size, p); };
        if (instance.hidden) ++info.hidden_instances;
        info.instanced_voxels += model.voxels.size();
        extend(info.scene_box, corner(glm::ivec3(0)), corner(model.size));
        if (const auto& box = boxes[instance.model])
            extend(info.voxel_box, corner(box->first), corner(box->second));
    }
}

void count_materials(const VoxFile& file, VoxInfo& info) {
    std::map<std::int32_t, const VoxDict*> last;
    for (const VoxRecord& record : file.materials)
        last[record.id] = &record.attributes;
    for (const auto& [id, attributes] : last) {
        const std::string* type = find_value(*attributes, "_type");
        count_name(info.materials, type != nullptr ? std::string_view(*type) : "(none)");
    }
}

nlohmann::json json_of(glm::ivec3 v) {
    return {v.x, v.y, v.z};
}

nlohmann::json json_of(const std::optional<VoxBox>& box) {
    if (!box) return nullptr;
    return {json_of(box->first), json_of(box->second)};
}

std::string text_of(glm::ivec3 v) {
    return fmt::format("{} {} {}", v.x, v.y, v.z);
}

std::string text_of(const std::optional<VoxBox>& box) {
    return box ? fmt::format("{} to {}", text_of(box->first), text_of(box->second)) : "empty";
}

std::string text_of(const std::map<std::string, std::size_t>& counts) {
    std::string text;
    for (const auto& [name, count] : counts)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
    return text.empty() ? "none" : text;
}

nlohmann::json json_of(const VoxDict& dict) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& [key, value] : dict)
        object[printable(key, kNameLength)] = printable(value);
    return object;
}

nlohmann::json json_of(const SavedCamera& saved) {
    const Camera& camera = saved.camera;
    return {{"name", saved.name},
            {"position", {camera.position.x, camera.position.y, camera.position.z}},
            {"yaw_deg", camera.yaw_deg},
            {"pitch_deg", camera.pitch_deg},
            {"fov_y_deg", camera.fov_y_deg},
            {"projection", kProjectionNames[static_cast<std::size_t>(camera.projection)]},
            {"height", saved.height}};
}

template <class T>
nlohmann::json list_of(const std::vector<T>& items) {
    nlohmann::json list = nlohmann::json::array();
    for (const T& item : items)
        list.push_back(json_of(item));
    return list;
}

// "_inf: _i 0.7, _k 255 255 255".
std::string text_of(const VoxDict& dict) {
    std::string text;
    for (const auto& [key, value] : dict) {
        const std::string shown = printable(value, kNameLength);
        if (key == "_type") continue;
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", printable(key, kNameLength), shown);
    }
    const std::string* type = find_value(dict, "_type");
    return fmt::format("{}: {}", type != nullptr ? printable(*type, kNameLength) : "(no type)", text);
}

std::string text_of(const SavedCamera& saved) {
    const Camera& camera = saved.camera;
    return fmt::format("{}: at {:.6g} {:.6g} {:.6g}, yaw {:.6g}, pitch {:.6g}, fov {:.6g}, {}", saved.name,
                       camera.position.x, camera.position.y, camera.position.z, camera.yaw_deg,
                       camera.pitch_deg, camera.fov_y_deg,
                       kProjectionNames[static_cast<std::size_t>(camera.projection)]);
}

}  // namespace

Result<VoxInfo> summarize(const VoxFile& file) {
    VoxInfo info{.version = file.version,
                 .models = file.models.size(),
                 .layers = file.layers.size(),
                 .cameras = file.cameras.size(),
                 .old_materials = file.old_materials.size(),
                 .has_palette = file.has_palette,
                 .has_imap = file.imap.has_value(),
                 .settings = render_objects(file),
                 .saved_cameras = saved_cameras(file),
                 .warnings = file.warnings};
    auto placed = has_graph(file) ? vox_instances(file, 0) : Result(corner_instances(file));
    if (!placed) return Failure{placed.reason()};
    measure_models(file, info);
    measure_instances(file, placed.value(), info);
    count_materials(file, info);
    for (const VoxNode& node : file.nodes) {
        if (const auto* transform = std::get_if<VoxTransform>(&node))
            info.max_frames = std::max(info.max_frames, transform->frames.size());
        if (const auto* shape = std::get_if<VoxShape>(&node))
            info.max_models_per_shape = std::max(info.max_models_per_shape, shape->models.size());
    }
    for (const VoxUnknownChunk& chunk : file.unknown)
        count_name(info.unknown_chunks, {chunk.id.data(), chunk.id.size()});
    return info;
}

nlohmann::json to_json(const VoxInfo& info) {
    nlohmann::json sizes = nlohmann::json::array();
    for (std::size_t i = 0; i < std::min(info.sizes.size(), kInfoSizes); ++i)
        sizes.push_back(json_of(info.sizes[i]));
    return {{"version", info.version},
            {"models", info.models},
            {"sizes", sizes},
            {"voxels", info.voxels},
            {"instances", info.instances},
            {"hidden_instances", info.hidden_instances},
            {"instanced_voxels", info.instanced_voxels},
            {"layers", info.layers},
            {"cameras", info.cameras},
            {"materials", nlohmann::json(info.materials)},
            {"matt", info.old_materials},
            {"max_frames", info.max_frames},
            {"max_models_per_shape", info.max_models_per_shape},
            {"palette", info.has_palette ? "file" : "default"},
            {"colours_used", info.colours_used},
            {"scene_box", json_of(info.scene_box)},
            {"voxel_box", json_of(info.voxel_box)},
            {"out_of_size", info.out_of_size},
            {"duplicates", info.duplicates},
            {"index0", info.index0},
            {"imap", info.has_imap},
            {"unknown_chunks", nlohmann::json(info.unknown_chunks)},
            {"settings", list_of(info.settings)},
            {"saved_cameras", list_of(info.saved_cameras)},
            {"warnings", info.warnings}};
}

std::string describe(const VoxInfo& info) {
    std::string text;
    const auto line = [&](std::string_view name, const std::string& value) {
        text += fmt::format("{:<17}{}\n", name, value);
    };
    line("version", fmt::format("{}", info.version));
    line("models", fmt::format("{} with {} voxels", info.models, info.voxels));
    for (std::size_t i = 0; i < std::min(info.sizes.size(), kInfoSizes); ++i)
        line("", fmt::format("model {}: {}", i, text_of(info.sizes[i])));
    if (info.sizes.size() > kInfoSizes) line("", fmt::format("and {} more", info.sizes.size() - kInfoSizes));
    line("instances", fmt::format("{} ({} hidden) with {} voxels", info.instances, info.hidden_instances,
                                  info.instanced_voxels));
    line("scene box", text_of(info.scene_box));
    line("voxel box", text_of(info.voxel_box));
    line("palette", fmt::format("{}, {} indices used{}", info.has_palette ? "of the file" : "default",
                                info.colours_used, info.has_imap ? ", reordered on screen (IMAP)" : ""));
    line("materials", text_of(info.materials));
    if (info.old_materials > 0) line("old materials", fmt::format("{} (MATT)", info.old_materials));
    line("layers", fmt::format("{}", info.layers));
    const std::string set = fmt::format(", {} of them set", info.saved_cameras.size());
    line("cameras", fmt::format("{}{}", info.cameras, info.cameras > 0 ? set : ""));
    for (const SavedCamera& camera : info.saved_cameras)
        line("", text_of(camera));
    for (std::size_t i = 0; i < info.settings.size(); ++i)
        line(i == 0 ? "settings" : "", text_of(info.settings[i]));
    line("frames", fmt::format("{} keys in a transform, {} models in a shape, at most", info.max_frames,
                               info.max_models_per_shape));
    line("oddities", fmt::format("{} voxels out of size, {} duplicates, {} of index 0", info.out_of_size,
                                 info.duplicates, info.index0));
    if (!info.unknown_chunks.empty()) line("unknown chunks", text_of(info.unknown_chunks));
    for (const std::string& warning : info.warnings)
        line("warning", warning);
    return text;
}

}  // namespace voxilux
