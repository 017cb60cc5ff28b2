#include "jobs/film_part.h"

#include <algorithm>
#include <array>
#include <bit>

#include "base/error.h"
#include "base/fnv.h"
#include "base/json.h"
#include "scene/scene_hash.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kFormat = 4;  // of the attribute; another one is refused

Json matrix_json(const std::optional<glm::mat4>& matrix) {
    if (!matrix) return nullptr;
    Json numbers = Json::array();
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j)
            numbers.push_back((*matrix)[i][j]);
    }
    return numbers;
}

std::optional<glm::mat4> matrix_of(const Json& json) {
    if (json.is_null()) return std::nullopt;
    const auto numbers = json.get<std::array<float, 16>>();
    glm::mat4 matrix(0.0f);
    for (int i = 0; i < 16; ++i)
        matrix[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)];
    return matrix;
}

Json colour_json(const std::optional<glm::vec3>& colour) {
    if (!colour) return nullptr;
    return {colour->x, colour->y, colour->z};
}

std::optional<glm::vec3> colour_of(const Json& json) {
    if (json.is_null()) return std::nullopt;
    const auto numbers = json.get<std::array<float, 3>>();
    return glm::vec3(numbers[0], numbers[1], numbers[2]);
}

Json file_json(const ExrOptions& file) {
    const ExrWindow& window = file.window;
    return {{"window", {window.x, window.y, window.full_width, window.full_height}},
            {"comments", file.comments},
            {"background", colour_json(file.background)},
            {"world_to_camera", matrix_json(file.world_to_camera)},
            {"world_to_ndc", matrix_json(file.world_to_ndc)}};
}

void check(bool is_sound, const char* what) {
    if (!is_sound) throw std::runtime_error(what);
}

// `film` gives the size of the picture, which lies inside the window's frame.
ExrOptions file_of(const Json& json, const FilmSums& film) {
    const auto window = json.at("window").get<std::array<int, 4>>();
    const auto is_inside = [](int begin, int size, int full) {
        return full == 0 ? begin == 0 : begin >= 0 && full <= kMaxExrSide && begin <= full - size;
    };
    check(is_inside(window[0], film.width, window[2]) && is_inside(window[1], film.height, window[3]),
          "its window is damaged");
    return {.window = {window[0], window[1], window[2], window[3]},
            .comments = json.at("comments").get<std::string>(),
            .background = colour_of(json.at("background")),
            .world_to_camera = matrix_of(json.at("world_to_camera")),
            .world_to_ndc = matrix_of(json.at("world_to_ndc"))};
}

// Shards are counted from 1 wherever people see them.
Json part_json(const FilmPart& part) {
    Json done = Json::array();
    for (const auto& [shard, samples] : part.done)
        done.push_back({{"shard", shard + 1}, {"samples", samples}});
    return {{"format", kFormat},
            {"render", part.render},
            {"spp", part.spp},
            {"shards", part.shards},
            {"done", done},
            {"rows_ahead", part.rows_ahead},
            {"independent", part.film.is_independent},
            {"file", file_json(part.file)}};
}

void read_json(const Json& json, FilmPart& part) {
    check(json.at("format") == kFormat, "it has another format, of another version");
    part.render = json.at("render");
    check(part.render.is_object(), "its description is damaged");
    part.spp = json.at("spp").get<std::uint32_t>();
    part.shards = json.at("shards").get<std::uint32_t>();
    check(part.shards >= 1 && part.shards <= kMaxShards, "its number of shards is damaged");
    for (const Json& row : json.at("done")) {
        const auto shard = row.at("shard").get<std::uint32_t>();
        const auto samples = row.at("samples").get<std::uint32_t>();
        check(shard >= 1 && shard <= part.shards, "it has a shard that is none");
        check(samples <= Shard{shard - 1, part.shards}.samples(part.spp),
              "it has more samples than its shard");
        check(part.done.emplace(shard - 1, samples).second, "it has a shard twice");
    }
    part.rows_ahead = json.at("rows_ahead").get<std::uint32_t>();
    check(!part.done.empty() && (part.rows_ahead == 0 || part.done.size() == 1), "its samples are damaged");
    check(part.rows_ahead < static_cast<std::uint32_t>(part.film.height), "its rows are damaged");
    part.film.is_independent = json.at("independent").get<bool>();
    part.file = file_of(json.at("file"), part.film);
}

// The samples of each row follow from those of the shards.
void count_rows(FilmPart& part) {
    const auto rows = static_cast<std::size_t>(part.film.height);
    part.film.even.assign(rows, 0);
    part.film.odd.assign(rows, 0);
    for (std::size_t row = 0; row < rows; ++row) {
        for (const auto& [index, samples] : part.done) {
            const std::uint32_t own = samples + (row < part.rows_ahead ? 1 : 0);
            const std::uint32_t even = Shard{index, part.shards}.even_samples(own);
            part.film.even[row] += even;
            part.film.odd[row] += own - even;
        }
    }
}

std::uint64_t hash_of_text(std::uint64_t hash, const std::string& text) {
    for (const char c : text)
        hash = fnv1a(hash, static_cast<unsigned char>(c));
    return fnv1a(hash, text.size());
}

std::string checksum_of(const Image& image) {
    std::uint64_t hash = kFnvStart;
    for (const char* name : {kPartAttribute, kReportAttribute})
        hash = hash_of_text(hash, image.attributes.at(name));
    for (const auto& [name, words] : image.words) {
        hash = hash_of_text(hash, name);
        for (const std::uint32_t word : words)
            hash = fnv1a(hash, word);
    }
    for (const char* name : {"P.X", "P.Y", "P.Z", "Z"}) {
        const auto plane = image.channels.find(name);
        if (plane == image.channels.end()) continue;
        for (const float value : plane->second.pixels)
            hash = fnv1a(hash, std::bit_cast<std::uint32_t>(value));
    }
    return fmt::format("{:016x}", hash);
}

std::map<std::string, std::uint64_t> counts_of(const Json& json) {
    std::map<std::string, std::uint64_t> counts;
    for (const auto& [name, count] : json.items())
        counts[name] = count.get<std::uint64_t>();
    return counts;
}

Json parsed(const std::string& text) {
    std::optional<Json> json = parse_json<Json>(text);
    check(json.has_value(), "its description is no JSON");
    return *std::move(json);
}

FilmPart decode(const Image& image) {
    const auto description = image.attributes.find(kPartAttribute);
    const auto report = image.attributes.find(kReportAttribute);
    check(description != image.attributes.end() && report != image.attributes.end(),
          "it is a picture without sums; parts are written by render --shard");
    const auto checksum = image.attributes.find(kChecksumAttribute);
    check(checksum != image.attributes.end(), "it has another format, of another version");
    check(checksum->second == checksum_of(image), "it is damaged: its checksum is not that of its contents");
    FilmPart part;
    part.film = load_sums(image).value_or_throw(ExitCode::input_refused);
    part.report = parsed(report->second);
    (void)counts_of(part.report.at("work"));
    (void)counts_of(part.report.at("faults"));
    read_json(parsed(description->second), part);
    count_rows(part);
    return part;
}

}  // namespace

Json render_key(const Scene& scene, const RenderPlan& plan) {
    const RenderSettings& settings = plan.settings;
    Json effects = Json::array();
    for (const EffectState& state : plan.effects) {
        if (state.on) effects.push_back(name_of(state.effect));
    }
    return {{"version", VX_VERSION},
            {"size", {plan.image_size.x, plan.image_size.y}},
            {"crop", {plan.first_pixel.x, plan.first_pixel.y, settings.size.x, settings.size.y}},
            {"seed", settings.seed},
            {"sequence", name_of(settings.sequence)},
            {"ao_rays", settings.ao_rays},
            {"ao_radius", settings.ao_radius},
            {"effects", effects},
            {"scene_hash", fmt::format("{:016x}", sample_hash(scene))}};
}

FilmPart part_of(const Scene& scene, RenderOutcome outcome, Json report, const ExrOptions& file) {
    VX_ASSERT(outcome.film.has_value());
    const Shard& shard = outcome.plan.shard;
    return {.render = render_key(scene, outcome.plan),
            .spp = outcome.plan.settings.spp,
            .shards = shard.count,
            .done = {{shard.index, outcome.statistics.samples}},
            .rows_ahead = outcome.rows_ahead,
            .film = std::move(*outcome.film),
            .report = std::move(report),
            .file = file};
}

Image image_of(FilmPart part) {
    Image image = picture_of(part.film);
    image.attributes[kPartAttribute] = json_text(part_json(part));
    image.attributes[kReportAttribute] = json_text(part.report);
    store_sums(std::move(part.film), image);
    seal(image);
    return image;
}

void seal(Image& image) {
    image.attributes[kChecksumAttribute] = checksum_of(image);
}

FilmPart read_part(const fs::path& path) {
    const Image image = read_exr_part(path);
    try {
        return decode(image);
    } catch (const std::exception& cause) {
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: not a part of a render: {}", path.string(), cause.what()));
    }
}

std::optional<std::string> difference(const Json& render, const Json& other) {
    for (const auto& [key, value] : other.items()) {
        const Json own = render.contains(key) ? render.at(key) : Json(nullptr);
        if (own != value)
            return fmt::format("its {} is {} and not {}", key, json_text(own), json_text(value));
    }
    if (render.size() != other.size()) return "it has other settings";
    return std::nullopt;
}

FilmStart start_of(FilmPart part) {
    VX_ASSERT_EQ(part.done.size(), std::size_t{1});
    return {.sums = std::move(part.film),
            .position = {.samples = part.done.begin()->second, .rows_ahead = part.rows_ahead},
            .work = counts_of(part.report.at("work")),
            .faults = counts_of(part.report.at("faults"))};
}

}  // namespace voxilux
