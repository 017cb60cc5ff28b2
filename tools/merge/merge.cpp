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

PartSum read_and_add(const MergeCommand& command) {
    PartSum sum{.mixes_devices = command.allow_mixed_devices};
    for (const std::string& file : command.parts)
        add_part_file(sum, file);
    const SampleSet missing = missing_samples(sum.total);
    if (!missing.empty() && !command.partial) {
        throw Error(
            ExitCode::input_refused,
            fmt::format("the picture is not complete: samples {} are missing; --partial merges what is "
                        "there",
                        missing.text()));
    }
    if (sum.total.render.at(kDeviceKey) == kMixedDevices && !command.report.quiet)
        print_message("note: parts of several kinds of devices: the bytes are those of no single render\n");
    return sum;
}

// A picture as an uninterrupted render writes it, or one that can be merged again.
Image picture_to_write(FilmPart part, bool is_part) {
    if (is_part) return image_of(std::move(part));
    Image image = picture_of(std::move(part.film));
    image.attributes[kReportAttribute] = json_text(part.report);
    return image;
}

void write_outputs(const PictureFiles& pictures, FilmPart part) {
    ExrOptions options = part.file;
    options.reproducible = pictures.reproducible;
    options.software = "voxilux " VX_VERSION;
    const ToneMapOptions tone = tone_of(pictures, part.exposure_ev);
    const Image image = picture_to_write(std::move(part), pictures.is_part);
    WriteFaults ignored;  // the report has those of the parts
    for (const std::string& file : pictures.files)
        write_picture(file, image, options, image, tone, ignored);
}

void print_merge(const MergeCommand& command, const nlohmann::ordered_json& report) {
    for (const auto& [name, count] : report.at("faults").items()) {
        if (count != 0) print_message("warning: fault {} counted {} times\n", name, json_text(count));
    }
    if (!command.report.prints()) return;
    print_result("merged    {} parts, {} samples per pixel\n", command.parts.size(),
                 json_text(report.at("samples")));
    print_result("error     {}\n", json_text(report.at("error").at("estimate")));
    for (const std::string& file : command.pictures.files)
        print_result("wrote     {}\n", file);
}

}  // namespace

void add_merge_flags(Flags& flags, MergeCommand& command) {
    flags.add("PART", "", command.parts, "EXR files of render --samples or --shard, in any order").required();
    add_picture_flag(flags, command.pictures.files, "picture to write, .exr or .png; may repeat").required();
    flags.add_switch(
        "--partial", command.partial,
        "write the mean of what is there when samples are missing; its EXR keeps the sums for another merge");
    flags.add_switch(
        "--allow-mixed-devices", command.allow_mixed_devices,
        "accept parts of other kinds of devices: the picture is as accurate, but its bytes are those "
        "of no single render");
    flags.add_switch("--reproducible", command.pictures.reproducible,
                     "no date or times in the files: the bytes of an uninterrupted render");
    add_tone_flags(flags, command.pictures.tone);
    add_report_flags(flags, command.report);
}

int run_merge(const MergeCommand& command) {
    std::vector<std::string> outputs = command.pictures.files;
    outputs.push_back(command.report.json);
    check_outputs(outputs, command.parts);
    PartSum sum = read_and_add(command);
    FilmPart& part = sum.total;
    try {
        part.report = merged_report(part, command.pictures.reproducible);
    } catch (const nlohmann::json::exception& cause) {
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: its report is damaged: {}", command.parts.front(), cause.what()));
    }
    const nlohmann::ordered_json report = part.report;
    PictureFiles pictures = command.pictures;
    pictures.is_part = command.partial;
    write_outputs(pictures, std::move(part));
    print_merge(command, report);
    write_json(command.report.json, report);
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
