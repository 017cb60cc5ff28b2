#include "jobs/file_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/file.h"
#include "base/json.h"
#include "base/printable.h"
#include "base/statistics.h"
#include "formats/image_file.h"
#include "formats/scene_toml.h"
#include "formats/vox_info.h"
#include "formats/vox_read.h"
#include "jobs/picture_files.h"
#include "scene/facts.h"
#include "scene/scene_camera.h"
#include "scene/scene_hash.h"

namespace voxilux {
namespace {

using SortedJson = nlohmann::json;

constexpr std::size_t kShownAttribute = 75;  // characters of a text attribute in one line

template <class Vector>
SortedJson numbers(const Vector& v) {
    return {v.x, v.y, v.z};
}

SortedJson scene_json(const Scene& scene, const SceneFacts& facts, const Camera& camera) {
    const RenderSettings& s = scene.settings;
    return {{"scene_hash", fmt::format("{:016x}", sample_hash(scene))},
            {"voxels", facts.voxel_count},
            {"instances", facts.instance_count},
            {"models", scene.models.size()},
            {"spheres", facts.sphere_count},
            {"materials", facts.material_count},
            {"voxel_box", facts.has_voxels ? SortedJson{numbers(facts.box.lo), numbers(facts.box.hi)}
                                           : SortedJson(nullptr)},
            {"fill_ratio", facts.fill_ratio},
            {"sun", facts.sun_reaches},
            {"sky", facts.has_sky},
            {"emitters", facts.has_emitters},
            {"glass", facts.has_glass},
            {"metal", facts.has_metal},
            {"camera",
             {{"position", numbers(camera.position)},
              {"yaw_deg", camera.yaw_deg},
              {"pitch_deg", camera.pitch_deg},
              {"fov_y_deg", camera.fov_y_deg},
              {"projection", kProjectionNames[static_cast<std::size_t>(camera.projection)]},
              {"of_the_file", scene.camera.has_value()}}},
            {"size", {s.size.x, s.size.y}},
            {"spp", s.spp},
            {"warnings", scene.warnings}};
}

// The range of a plane of numbers. The mean is over its finite values.
struct Range {
    float low = std::numeric_limits<float>::infinity();
    float high = -std::numeric_limits<float>::infinity();
    double mean = 0.0;
    std::size_t non_finite = 0;
};

Range range_of(const std::vector<float>& values) {
    Range range;
    CompensatedSum sum;
    for (const float value : values) {
        if (!std::isfinite(value)) {
            ++range.non_finite;
            continue;
        }
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
        sum.add(value);
    }
    const std::size_t finite = values.size() - range.non_finite;
    if (finite > 0) range.mean = sum.value() / static_cast<double>(finite);
    return range;
}

const char* type_of(const Image& image, const Image::Channel& channel) {
    if (image.display_referred) return "8-bit";
    return channel.precision == Image::Precision::half ? "half" : "float";
}

void add_channel(const Image& image, const std::string& name, FileFacts& facts) {
    const Image::Channel& channel = image.channels.at(name);
    const Range range = range_of(channel.pixels);
    const bool any = range.non_finite < channel.pixels.size();
    facts.text += any ? fmt::format("channel   {:<14} {:<5}  {:.6g} to {:.6g}, mean {:.6g}", name,
                                    type_of(image, channel), range.low, range.high, range.mean)
                      : fmt::format("channel   {:<14} {:<5}  no finite value", name, type_of(image, channel));
    if (range.non_finite > 0) facts.text += fmt::format(", {} not finite", range.non_finite);
    facts.text += "\n";
    facts.json["channels"].push_back({{"name", name},
                                      {"type", type_of(image, channel)},
                                      {"min", any ? SortedJson(range.low) : SortedJson(nullptr)},
                                      {"max", any ? SortedJson(range.high) : SortedJson(nullptr)},
                                      {"mean", any ? SortedJson(range.mean) : SortedJson(nullptr)},
                                      {"non_finite", range.non_finite}});
}

// A text attribute that holds JSON, like the report, stays JSON.
SortedJson attribute_json(const std::string& text) {
    const std::optional<SortedJson> parsed = parse_json<SortedJson>(text);
    return parsed && parsed->is_object() ? *parsed : SortedJson(printable(text));
}

// What `render` would say about the file: its warnings, and what is shown in a simplified form.
std::vector<std::string> render_warnings(const VoxFile& file, const std::filesystem::path& path) {
    try {
        const Scene scene = scene_of_file(file, path);
        std::vector<std::string> warnings = scene.warnings;
        const std::vector<std::string> simplified = measure_scene(scene).simplified;
        warnings.insert(warnings.end(), simplified.begin(), simplified.end());
        return warnings;
    } catch (const Error& refusal) {
        return {fmt::format("render refuses this file: {}", refusal.what())};
    }
}

FileFacts scene_facts(const std::filesystem::path& path) {
    const Scene scene = load_scene(path);
    const SceneFacts facts = measure_scene(scene);
    const Camera camera = camera_of(scene);
    const RenderSettings& s = scene.settings;
    std::string text = describe(facts);
    text +=
        fmt::format("camera: at {:.6g} {:.6g} {:.6g}, yaw {:.6g}, pitch {:.6g}, fov {:.6g} degrees ({})\n",
                    camera.position.x, camera.position.y, camera.position.z, camera.yaw_deg, camera.pitch_deg,
                    camera.fov_y_deg, scene.camera ? "of the file" : "frames the scene");
    text += fmt::format("picture: {}x{}, {} samples per pixel\n", s.size.x, s.size.y, s.spp);
    for (const std::string& warning : scene.warnings)
        text += fmt::format("warning: {}\n", warning);
    return {text, scene_json(scene, facts, camera)};
}

FileFacts image_facts(const std::filesystem::path& path) {
    const Image image = read_image(path);
    FileFacts facts{.text = fmt::format("size      {}x{}\n", image.width, image.height)};
    facts.json = {{"size", {image.width, image.height}},
                  {"channels", SortedJson::array()},
                  {"attributes", SortedJson::object()}};
    for (const auto& [name, channel] : image.channels)
        add_channel(image, name, facts);
    for (const auto& [name, text] : image.attributes) {
        facts.text += fmt::format("text      {}: {}\n", name, printable(text, kShownAttribute));
        facts.json["attributes"][name] = attribute_json(text);
    }
    return facts;
}

}  // namespace

FileFacts vox_file_facts(const VoxFile& file, const std::filesystem::path& path) {
    auto summary = summarize(file);
    if (!summary)
        throw Error(ExitCode::input_refused, fmt::format("{}: {}", path.string(), summary.reason()));
    VoxInfo info = std::move(summary).value();
    info.warnings = render_warnings(file, path);
    return {describe(info), to_json(info)};
}

FileFacts file_facts(const std::filesystem::path& path) {
    if (has_ending(path, ".vox")) return vox_file_facts(load_vox(path), path);
    if (has_ending(path, ".toml")) return scene_facts(path);
    const bool is_checkpoint = has_ending(path, ".part");  // FILE.exr.part
    if (is_exr(path) || is_png(path) || is_checkpoint) return image_facts(path);
    throw Error(
        ExitCode::input_refused,
        fmt::format("{}: info reads .vox, .toml, .exr and .png files, voxels of other formats and meshes",
                    path.string()));
}

}  // namespace voxilux
