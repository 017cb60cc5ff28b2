#include "jobs/merge_parts.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "jobs/report.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

void check_addable(const PartSum& sum, const FilmPart& part, const std::string& file) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ExitCode::input_refused, fmt::format("{}: {}", file, why));
    };
    if (part.rows_ahead > 0) refuse("it ends within a sample; render --resume finishes it");
    if (sum.files.empty()) return;
    const FilmPart& total = sum.total;
    const std::string& first = sum.files.begin()->second;
    const auto refuse_other = [&](const std::string& why) {
        refuse(fmt::format("not of the same render as {}: {}", first, why));
    };
    if (const auto other = difference(part.render, total.render)) refuse_other(*other);
    if (part.spp != total.spp)
        refuse_other(fmt::format("it is of {} samples and not {}", part.spp, total.spp));
    if (part.shards != total.shards)
        refuse_other(fmt::format("it is of {} shards and not {}", part.shards, total.shards));
    const bool same_planes =
        std::ranges::equal(part.film.sums, total.film.sums, [](const auto& a, const auto& b) {
            return a.first == b.first && a.second.size() == b.second.size();
        });
    if (!same_planes || part.film.firsts.size() != total.film.firsts.size())
        refuse_other("it has other channels");
    for (const auto& [shard, samples] : part.done) {
        const auto known = sum.files.find(shard);
        if (known != sum.files.end())
            refuse(fmt::format("its samples of shard {}/{} are in {} already", shard + 1, part.shards,
                               known->second));
    }
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

// Rows of passes or effects with a name under `key`.
void add_rows(Json& total, const Json& more, const char* key) {
    for (const Json& row : more) {
        const auto known =
            std::ranges::find_if(total, [&](const Json& own) { return own.at(key) == row.at(key); });
        if (known == total.end()) {
            total.push_back(row);
            continue;
        }
        for (const char* number : {"count", "ms"}) {
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
    if (total.contains("effects") && more.contains("effects"))
        add_rows(total["effects"], more.at("effects"), "name");
    if (total.contains("peak_rss_mib") && more.contains("peak_rss_mib"))
        total["peak_rss_mib"] = std::max(total["peak_rss_mib"], more.at("peak_rss_mib"));
}

std::uint64_t samples_of(const FilmPart& part) {
    std::uint64_t samples = 0;
    for (const auto& [shard, own] : part.done)
        samples += own;
    return samples;
}

std::string shards_text(const FilmPart& part) {
    std::vector<std::uint32_t> numbers;
    for (const auto& [shard, samples] : part.done)
        numbers.push_back(shard + 1);
    return fmt::format("{} of {}", fmt::join(numbers, ", "), part.shards);
}

}  // namespace

void add_part(PartSum& sum, FilmPart part, const std::string& file) {
    check_addable(sum, part, file);
    for (const auto& [shard, samples] : part.done)
        sum.files[shard] = file;
    if (sum.total.film.sums.empty()) {
        sum.total = std::move(part);
        return;
    }
    FilmPart& total = sum.total;
    // Positions are those of the first sample that the picture has.
    if (part.done.begin()->first < total.done.begin()->first) std::swap(part.film, total.film);
    add_film(total.film, part.film);
    total.done.merge(part.done);
    try {
        add_report(total.report, part.report);
    } catch (const nlohmann::json::exception& cause) {
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: its report is damaged: {}", file, cause.what()));
    }
}

std::vector<std::string> missing_shards(const FilmPart& part) {
    std::vector<std::string> missing;
    for (std::uint32_t index = 0; index < part.shards; ++index) {
        const std::uint32_t wanted = Shard{index, part.shards}.samples(part.spp);
        const auto found = part.done.find(index);
        const std::uint32_t done = found == part.done.end() ? 0 : found->second;
        if (done == wanted) continue;
        missing.push_back(
            done == 0 ? fmt::format("{}/{}", index + 1, part.shards)
                      : fmt::format("{}/{} ({} of {} samples)", index + 1, part.shards, done, wanted));
    }
    return missing;
}

Json merged_report(const FilmPart& total, bool reproducible) {
    const bool is_whole = missing_shards(total).empty();
    Json report = reproducible ? reproducible_report(total.report) : total.report;
    report["samples"] = samples_of(total);
    report["error"] = error_json(
        claimed_error_of(total.film, total.report.at("faults").get<std::map<std::string, std::uint64_t>>()));
    if (is_whole)
        report.erase("shard");
    else
        report["shard"] = shards_text(total);
    if (is_whole && report.contains("stopped")) report["stopped"] = "finished";
    return report;
}

}  // namespace voxilux
