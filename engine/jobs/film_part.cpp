#include "jobs/film_part.h"

#include <algorithm>
#include <array>

#include "base/build_id.h"
#include "base/error.h"
#include "base/json.h"
#include "base/read_or_refuse.h"
#include "jobs/part_checksum.h"
#include "scene/scene_hash.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kFormat = 5;  // of the attribute; other formats are refused
constexpr std::string_view kPartKind = "a part of a render";
constexpr int kRowsAtOnce = 64;  // whole blocks of an EXR

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

// `film` gives the size of the image, which lies inside the window's frame.
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

Json part_json(const FilmPart& part) {
    return {{"format", kFormat},
            {"render", part.render},
            {"spp", part.spp},
            {"samples", part.samples.text()},
            {"ahead", {{"rows", part.rows_ahead}, {"sample", part.sample_ahead}}},
            {"independent", part.film.is_independent},
            {"exposure_ev", part.exposure_ev ? Json(*part.exposure_ev) : Json(nullptr)},
            {"file", file_json(part.file)}};
}

// The film already has its size.
void read_json(const Json& json, FilmPart& part) {
    check(json.at("format") == kFormat, "it has another format, of another version");
    part.render = json.at("render");
    check(part.render.is_object(), "its description is damaged");
    part.spp = json.at("spp").get<std::uint32_t>();
    const auto text = json.at("samples").get<std::string>();
    const std::optional<SampleSet> samples = SampleSet::parse(text);
    check(samples || text.empty(), "its samples are damaged");
    part.samples = samples.value_or(SampleSet{});
    part.rows_ahead = json.at("ahead").at("rows").get<std::uint32_t>();
    part.sample_ahead = json.at("ahead").at("sample").get<std::uint32_t>();
    check(part.rows_ahead < static_cast<std::uint32_t>(part.film.height), "its rows are damaged");
    check(part.rows_ahead == 0 || part.sample_ahead >= part.samples.end(), "its samples are damaged");
    part.film.is_independent = json.at("independent").get<bool>();
    if (const Json& stops = json.at("exposure_ev"); !stops.is_null()) part.exposure_ev = stops.get<float>();
    part.file = file_of(json.at("file"), part.film);
}

// The samples of each row.
void count_rows(FilmPart& part) {
    const std::uint32_t size = part.samples.size();
    const std::uint32_t even = part.samples.even_samples(size);
    const auto rows = static_cast<std::size_t>(part.film.height);
    part.film.even.assign(rows, even);
    part.film.odd.assign(rows, size - even);
    std::vector<std::uint32_t>& ahead = part.sample_ahead % 2 == 0 ? part.film.even : part.film.odd;
    for (std::size_t row = 0; row < part.rows_ahead; ++row)
        ++ahead[row];
}

std::string texts_of(const Image& head) {
    return head.attributes.at(kPartAttribute) + head.attributes.at(kReportAttribute);
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

// The part of an image, without its planes. `head` has the attributes of the image and its size.
FilmPart described_part(const Image& head) {
    const auto description = head.attributes.find(kPartAttribute);
    const auto report = head.attributes.find(kReportAttribute);
    check(description != head.attributes.end() && report != head.attributes.end(),
          "it is a picture without sums; parts are written by render --samples and --shard");
    check(head.attributes.contains(kChecksumAttribute), "it has another format, of another version");
    FilmPart part;
    part.film.width = head.width;
    part.film.height = head.height;
    part.report = parsed(report->second);
    (void)counts_of(part.report.at("work"));
    (void)counts_of(part.report.at("faults"));
    read_json(parsed(description->second), part);
    count_rows(part);
    return part;
}

FilmSums planes_of(const Image& rows) {
    Result<FilmSums> film = load_sums(rows);
    check(film.ok(), film.ok() ? "" : film.reason().c_str());
    return std::move(film).value();
}

}  // namespace

Json render_key(const Scene& scene, const RenderPlan& plan, const DeviceInfo& device) {
    const RenderSettings& settings = plan.settings;
    Json effects = Json::array();
    for (const EffectState& state : plan.effects) {
        if (state.on) effects.push_back(name_of(state.effect));
    }
    Json key{{"version", VX_VERSION},
             {"build", build_id()},
             {kDeviceKey, fmt::format("{}, {}", device.name, device.driver)},
             {"size", {plan.image_size.x, plan.image_size.y}},
             {"crop", {plan.first_pixel.x, plan.first_pixel.y, settings.size.x, settings.size.y}},
             {"seed", settings.seed},
             {"sequence", name_of(settings.sequence)},
             {"ao_rays", settings.ao_rays},
             {"ao_radius", settings.ao_radius},
             {"effects", effects},
             {"scene_hash", fmt::format("{:016x}", sample_hash(scene))}};
    if (plan.sums_guides) key["denoise"] = true;
    return key;
}

FilmPart part_of(const Scene& scene, RenderOutcome outcome, Json report, const ExrOptions& file,
                 std::uint32_t spp) {
    VX_ASSERT(outcome.film.has_value());
    const SampleSet& part = outcome.plan.part;
    const std::uint32_t done = outcome.statistics.samples;
    return {.render = render_key(scene, outcome.plan, outcome.statistics.device),
            .spp = spp,
            .samples = part.prefix(done),
            .rows_ahead = outcome.rows_ahead,
            .sample_ahead = outcome.rows_ahead == 0 ? 0 : part.sample(done),
            .film = std::move(*outcome.film),
            .report = std::move(report),
            .file = file,
            .exposure_ev = scene.exposure_ev};
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
    PartChecksum checksum;
    checksum.add(image);
    image.attributes[kChecksumAttribute] = checksum.text(texts_of(image));
}

void read_part_rows(const fs::path& path, const std::function<void(const FilmPart&)>& accept,
                    const std::function<void(std::size_t, const FilmSums&)>& take) {
    ExrRows file(path);
    const Image& head = file.head();
    accept(read_or_refuse(path.string(), kPartKind, [&] { return described_part(head); }));
    PartChecksum checksum;
    for (int first = 0; first < head.height; first += kRowsAtOnce) {
        const Image rows = file.read(first, std::min(kRowsAtOnce, head.height - first));
        checksum.add(rows);
        take(static_cast<std::size_t>(first),
             read_or_refuse(path.string(), kPartKind, [&] { return planes_of(rows); }));
    }
    read_or_refuse(path.string(), kPartKind, [&] {
        check(checksum.text(texts_of(head)) == head.attributes.at(kChecksumAttribute),
              "it is damaged: its checksum is not that of its contents");
    });
}

FilmPart read_part(const fs::path& path) {
    FilmPart part;
    read_part_rows(
        path, [&](const FilmPart& head) { part = head; },
        [&](std::size_t first, const FilmSums& rows) {
            add_rows(part.film, first, rows);
            set_firsts(part.film, first, rows);
        });
    return part;
}

std::optional<FilmPart> finished_part(const fs::path& path, const Json& render,
                                      const SampleSet& samples) try {
    FilmPart part;
    read_part_rows(
        path,
        [&](const FilmPart& head) {
            part = head;
            const bool is_it = !difference(head.render, render) && head.samples == samples;
            check(is_it && head.rows_ahead == 0, "");
        },
        [](std::size_t, const FilmSums&) {});
    return part;
} catch (const std::runtime_error&) {
    return std::nullopt;
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
    return {.sums = std::move(part.film),
            .position = {.samples = part.samples.size(), .rows_ahead = part.rows_ahead},
            .work = counts_of(part.report.at("work")),
            .faults = counts_of(part.report.at("faults"))};
}

}  // namespace voxilux
