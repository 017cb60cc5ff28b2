#include "jobs/merge_parts.h"

#include <algorithm>
#include <array>
#include <functional>

#include "base/error.h"
#include "jobs/report.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse_part(const std::string& file, const std::string& why) {
    throw Error(ExitCode::input_refused, fmt::format("{}: {}", file, why));
}

[[noreturn]] void refuse_other(const PartSum& sum, const std::string& file, const std::string& why) {
    refuse_part(file, fmt::format("not of the same render as {}: {}", sum.files.front().first, why));
}

// The file that a sample came from.
const std::string& file_of(const PartSum& sum, std::uint32_t sample) {
    const SampleSet one = SampleSet::shard(sample, 1, sample + 1);
    const auto found =
        std::ranges::find_if(sum.files, [&](const auto& row) { return row.second.common(one).has_value(); });
    VX_ASSERT(found != sum.files.end());
    return found->first;
}

// Checks what the description of a part tells.
void check_addable(const PartSum& sum, const FilmPart& part, const std::string& file) {
    if (part.rows_ahead > 0) refuse_part(file, "it ends within a sample; render --resume finishes it");
    if (part.samples.empty()) refuse_part(file, "it has no samples");
    if (sum.files.empty()) return;
    Json render = part.render;
    if (sum.mixes_devices) render[kDeviceKey] = sum.total.render.at(kDeviceKey);
    if (const auto other = difference(render, sum.total.render)) {
        const bool is_device = other->starts_with(fmt::format("its {} is", kDeviceKey));
        refuse_other(sum, file,
                     *other + (is_device ? "; other devices round differently: --allow-mixed-devices" : ""));
    }
    if (part.film.width != sum.total.film.width || part.film.height != sum.total.film.height)
        refuse_other(sum, file, "it has another size");
    if (const auto common = part.samples.common(sum.total.samples))
        refuse_part(file, fmt::format("its sample {} is in {} already", *common, file_of(sum, *common)));
}

bool have_same_planes(const FilmSums& film, const FilmSums& rows) {
    const auto components = [](const FilmSums& of, const auto& plane) {
        return plane.second.size() / static_cast<std::size_t>(of.width) / static_cast<std::size_t>(of.height);
    };
    const auto is_same = [&](const auto& a, const auto& b) {
        return a.first == b.first && components(film, a) == components(rows, b);
    };
    return std::ranges::equal(film.sums, rows.sums, is_same) &&
           std::ranges::equal(film.firsts, rows.firsts, is_same);
}

// Adds rows of a part whose first sample is `first_sample`.
void add_rows_of_part(PartSum& sum, std::uint32_t first_sample, std::size_t first, const FilmSums& rows,
                      const std::string& file) {
    FilmSums& film = sum.total.film;
    if (!sum.files.empty() && !have_same_planes(film, rows)) refuse_other(sum, file, "it has other channels");
    add_rows(film, first, rows);
    // Positions are those of the first sample in the image.
    if (sum.files.empty() || first_sample < sum.total.samples.first()) set_firsts(film, first, rows);
}

void add_numbers(Json& total, const Json& more) {
    for (const auto& [key, value] : more.items()) {
        if (value.is_number() && total.contains(key))
            total[key] = total[key].is_number_float()
                             ? Json(total[key].get<double>() + value.get<double>())
                             : Json(total[key].get<std::uint64_t>() + value.get<std::uint64_t>());
        else if (!total.contains(key))
            total[key] = value;
    }
}

// Adds up rows of passes or effects, which have a name under `key`.
void add_rows(Json& total, const Json& more, const char* key) {
    for (const Json& row : more) {
        const auto known =
            std::ranges::find_if(total, [&](const Json& own) { return own.at(key) == row.at(key); });
        if (known == total.end()) {
            total.push_back(row);
            continue;
        }
        for (const char* number : {"count", "ms", "wall_s", "cpu_s"}) {
            if (row.contains(number) && row.at(number).is_number())
                add_numbers(*known, {{number, row.at(number)}});
        }
        if (row.contains("max_ms")) (*known)["max_ms"] = std::max(known->at("max_ms"), row.at("max_ms"));
    }
}

void add_report(Json& total, const Json& more) {
    for (const char* key : {"work", "faults"})
        add_numbers(total[key], more.at(key));
    for (const char* key : {"wall_s", "cpu_s", "load_s", "gpu_ms"}) {
        if (total.contains(key) && more.contains(key))
            total[key] = total[key].get<double>() + more.at(key).get<double>();
    }
    if (total.contains("passes") && more.contains("passes"))
        add_rows(total["passes"], more.at("passes"), "label");
    if (total.contains("steps") && more.contains("steps"))
        add_rows(total["steps"], more.at("steps"), "label");
    if (total.contains("effects") && more.contains("effects"))
        add_rows(total["effects"], more.at("effects"), "name");
    if (total.contains("peak_rss_mib") && more.contains("peak_rss_mib"))
        total["peak_rss_mib"] = std::max(total["peak_rss_mib"], more.at("peak_rss_mib"));
}

// Adds everything of a part except its planes.
void add_description(PartSum& sum, FilmPart part, const std::string& file) try {
    const SampleSet samples = part.samples;
    if (sum.files.empty()) {
        part.film.sums = std::move(sum.total.film.sums);
        part.film.firsts = std::move(sum.total.film.firsts);
        sum.total = std::move(part);
    } else {
        FilmPart& total = sum.total;
        add_report(total.report, part.report);
        if (part.render.at(kDeviceKey) != total.render.at(kDeviceKey))
            total.render[kDeviceKey] = kMixedDevices;
        total.spp = std::max(total.spp, part.spp);
        total.samples.add(samples);
        std::ranges::transform(total.film.even, part.film.even, total.film.even.begin(), std::plus());
        std::ranges::transform(total.film.odd, part.film.odd, total.film.odd.begin(), std::plus());
    }
    sum.files.emplace_back(file, samples);
} catch (const nlohmann::json::exception& cause) {
    refuse_part(file, fmt::format("its report is damaged: {}", cause.what()));
}

}  // namespace

void add_part(PartSum& sum, const FilmPart& part, const std::string& file) {
    check_addable(sum, part, file);
    if (sum.files.empty()) {
        sum.total.film.width = part.film.width;
        sum.total.film.height = part.film.height;
    }
    add_rows_of_part(sum, part.samples.first(), 0, part.film, file);
    add_description(sum, part, file);
}

void add_part_file(PartSum& sum, const std::filesystem::path& file) {
    FilmPart part;
    const auto accept = [&](const FilmPart& head) {
        check_addable(sum, head, file.string());
        part = head;
        sum.total.film.width = head.film.width;
        sum.total.film.height = head.film.height;
    };
    read_part_rows(file, accept, [&](std::size_t first, const FilmSums& rows) {
        add_rows_of_part(sum, part.samples.first(), first, rows, file.string());
    });
    add_description(sum, std::move(part), file.string());
}

SampleSet missing_samples(const FilmPart& part) {
    return part.samples.missing(std::max(part.spp, part.samples.end()));
}

Json merged_report(const FilmPart& total, bool reproducible) {
    Json report = reproducible ? reproducible_report(total.report) : total.report;
    report["samples"] = total.samples.size();
    report["error"] = error_json(
        claimed_error_of(total.film, total.report.at("faults").get<std::map<std::string, std::uint64_t>>()));
    if (total.samples.is_leading())
        report.erase("sample_ranges");
    else
        report["sample_ranges"] = total.samples.text();
    if (report.contains("stopped") && missing_samples(total).empty()) report["stopped"] = "finished";
    return report;
}

}  // namespace voxilux
