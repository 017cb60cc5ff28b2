#include "merge/merge.h"

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "base/json.h"
#include "base/print.h"
#include "jobs/merge_parts.h"
#include "write_json.h"

namespace voxilux {
namespace {

constexpr std::size_t kNamedShards = 10;

std::string first_names(const std::vector<std::string>& names) {
    const std::size_t named = std::min(names.size(), kNamedShards);
    const std::string text =
        fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(named), ", "));
    return named == names.size() ? text : fmt::format("{} and {} more", text, names.size() - named);
}

FilmPart read_and_add(const MergeCommand& command) {
    PartSum sum;
    for (const std::string& file : command.parts)
        add_part(sum, read_part(file), file);
    const std::vector<std::string> missing = missing_shards(sum.total);
    if (!missing.empty() && !command.partial) {
        throw Error(
            ExitCode::input_refused,
            fmt::format("the picture is not complete: shard {} is missing; --partial merges what is there",
                        first_names(missing)));
    }
    return std::move(sum.total);
}

// A whole picture is as an uninterrupted render writes it; another one can be merged again.
Image picture_to_write(const FilmPart& part) {
    if (!missing_shards(part).empty()) return image_of(part);
    Image image = picture_of(part.film);
    image.attributes[kReportAttribute] = json_text(part.report);
    return image;
}

void write_outputs(const PictureFiles& pictures, const FilmPart& part) {
    ExrOptions options = part.file;
    options.reproducible = pictures.reproducible;
    options.software = "voxilux " VX_VERSION;
    const Image image = picture_to_write(part);
    WriteFaults ignored;  // the report has those of the parts
    for (const std::string& file : pictures.files)
        write_picture(file, image, options, image, pictures.tone, ignored);
}

void print_merge(const MergeCommand& command, const FilmPart& part) {
    for (const auto& [name, count] : part.report.at("faults").items()) {
        if (count != 0) print_message("warning: fault {} counted {} times\n", name, json_text(count));
    }
    if (!command.report.prints()) return;
    print_result("merged    {} of {} shards, {} of {} samples per pixel\n", part.done.size(), part.shards,
                 json_text(part.report.at("samples")), part.spp);
    print_result("error     {}\n", json_text(part.report.at("error").at("estimate")));
    for (const std::string& file : command.pictures.files)
        print_result("wrote     {}\n", file);
}

}  // namespace

void add_merge_flags(Flags& flags, MergeCommand& command) {
    flags.add("PART", "", command.parts, "EXR files of render --shard, in any order").required();
    add_picture_flag(flags, command.pictures.files, "picture to write, .exr or .png; may repeat").required();
    flags.add_switch(
        "--partial", command.partial,
        "write the mean of what is there when shards are missing; an EXR of it can be merged again");
    flags.add_switch("--reproducible", command.pictures.reproducible,
                     "no date or times in the files: the bytes of an uninterrupted render");
    add_tone_flags(flags, command.pictures.tone);
    add_report_flags(flags, command.report);
}

int run_merge(const MergeCommand& command) {
    std::vector<std::string> outputs = command.pictures.files;
    outputs.push_back(command.report.json);
    check_outputs(outputs, command.parts);
    FilmPart part = read_and_add(command);
    try {
        part.report = merged_report(part, command.pictures.reproducible);
    } catch (const nlohmann::json::exception& cause) {
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: its report is damaged: {}", command.parts.front(), cause.what()));
    }
    write_outputs(command.pictures, part);
    print_merge(command, part);
    write_json(command.report.json, part.report);
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
