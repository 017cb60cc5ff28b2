#include "merge/merge.h"

#include "base/error.h"
#include "formats/png.h"
#include "jobs/merge_parts.h"
#include "output_files.h"
#include "render/render_output.h"

namespace voxilux {
namespace {

void check_outputs(const MergeCommand& command) {
    for (const std::string& file : command.outputs) {
        if (!has_ending(file, ".exr") && !has_ending(file, ".png"))
            throw Error(ExitCode::usage, fmt::format("-o {}: the ending must be .exr or .png", file));
        check_writable(file);
    }
    check_writable(command.json);
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
                        fmt::join(missing, ", ")));
    }
    return std::move(sum.total);
}

// A whole picture is as an uninterrupted render writes it; another one can be merged again.
Image picture_to_write(const FilmPart& part) {
    if (!missing_shards(part).empty()) return image_of(part);
    Image image = picture_of(part.film);
    image.attributes[kReportAttribute] = part.report.dump();
    return image;
}

void write_outputs(const MergeCommand& command, const FilmPart& part) {
    ExrOptions options = part.file;
    options.reproducible = command.reproducible;
    options.software = "voxilux " VX_VERSION;
    const Image image = picture_to_write(part);
    for (const std::string& file : command.outputs) {
        if (has_ending(file, ".exr"))
            (void)write_exr(file, image, options);
        else
            write_png(file, to_display(image, tone_options(command.tone, command.exposure_ev)).image);
    }
}

void print_merge(const MergeCommand& command, const FilmPart& part) {
    for (const auto& [name, count] : part.report.at("faults").items()) {
        if (count != 0) fmt::print(stderr, "warning: fault {} counted {} times\n", name, count.dump());
    }
    if (command.quiet || command.json == "-") return;
    fmt::print("merged    {} of {} shards, {} of {} samples per pixel\n", part.done.size(), part.shards,
               part.report.at("samples").dump(), part.spp);
    fmt::print("error     {}\n", part.report.at("error").at("estimate").dump());
    for (const std::string& file : command.outputs)
        fmt::print("wrote     {}\n", file);
}

}  // namespace

CLI::App* add_merge(CLI::App& app, MergeCommand& command) {
    CLI::App* merge = app.add_subcommand("merge", "join the parts of one render that render --shard wrote");
    merge->add_option("PART", command.parts, "EXR files of render --shard, in any order")
        ->required()
        ->type_name("");
    merge->add_option("-o,--output", command.outputs, "picture to write, .exr or .png; may repeat")
        ->required()
        ->type_name("FILE")
        ->take_all()
        ->allow_extra_args(false);
    merge->add_flag(
        "--partial", command.partial,
        "write the mean of what is there when shards are missing; an EXR of it can be merged again");
    merge->add_flag("--reproducible", command.reproducible,
                    "no date or times in the files: the bytes of an uninterrupted render");
    merge->add_option("--tone", command.tone, "tone curve of a PNG: filmic or plain (default filmic)")
        ->type_name("NAME");
    merge->add_option("--exposure", command.exposure_ev, "exposure of a PNG in stops (default 0)")
        ->type_name("EV");
    merge->add_option("--json", command.json, "write the report as JSON; - is standard output")
        ->type_name("FILE");
    merge->add_flag("-q,--quiet", command.quiet, "print errors only");
    return merge;
}

int run_merge(const MergeCommand& command) {
    (void)tone_options(command.tone, command.exposure_ev);
    check_outputs(command);
    FilmPart part = read_and_add(command);
    part.report = merged_report(part, command.reproducible);
    write_outputs(command, part);
    print_merge(command, part);
    write_json(command.json, part.report);
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
