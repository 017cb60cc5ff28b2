#include "denoise/denoise.h"

#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/json.h"
#include "base/print.h"
#include "jobs/film_part.h"
#include "jobs/report.h"
#include "write_json.h"

namespace voxilux {
namespace {

Denoised denoise_part(const DenoiseCommand& command, const FilmPart& part) {
    Device device = open_device(command.device.request());
    Executor executor(device, pass_shaders(), {.cache_dir = command.device.cache_dir()});
    Denoised denoised = denoise_film(part.film, executor);
    denoised.claim =
        claim_with(denoised.claim, part.report.value("faults", std::map<std::string, std::uint64_t>{}));
    return denoised;
}

void write_outputs_of(const PictureFiles& pictures, const FilmPart& part, const Denoised& denoised) {
    ExrOptions options = part.file;
    options.reproducible = pictures.reproducible;
    options.software = "voxilux " VX_VERSION;
    Image image = picture_of(part.film);
    image.attributes[kReportAttribute] = json_text(part.report);
    add_denoised(denoised, image);
    const Image shown = shown_picture(denoised, image);
    const ToneMapOptions tone = tone_of(pictures, part.exposure_ev);
    WriteFaults ignored;  // the report has those of the samples
    for (const std::string& file : pictures.files)
        write_picture(file, image, options, shown, tone, ignored);
}

}  // namespace

void add_denoise_flags(Flags& flags, DenoiseCommand& command) {
    flags.add("FILE", "", command.input, "EXR of render --denoise on with --samples or --shard").required();
    add_picture_flag(flags, command.pictures.files,
                     "picture to write: .png, or .exr with the plain picture, too; may repeat")
        .required();
    flags.add_switch("--reproducible", command.pictures.reproducible,
                     "leave date and times out of the files: equal runs write equal bytes");
    add_tone_flags(flags, command.pictures.tone);
    add_report_flags(flags, command.report);
    add_device_flag(flags, command.device.selector);
}

int run_denoise(const DenoiseCommand& command) {
    std::vector<std::string> outputs = command.pictures.files;
    outputs.push_back(command.report.json);
    check_outputs(outputs, {command.input});
    FilmPart part = read_part(command.input);
    if (!has_guides(part.film))
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: it was rendered without --denoise on, and lacks what the denoiser needs",
                                command.input));
    const Denoised denoised = denoise_part(command, part);
    if (command.pictures.reproducible) part.report = reproducible_report(part.report);
    part.report["command"] = "denoise";
    part.report["denoised"] = denoised_json(denoised);
    write_outputs_of(command.pictures, part, denoised);
    if (command.report.prints()) {
        print_result("{}", denoised_text(denoised));
        for (const std::string& file : command.pictures.files)
            print_result("wrote     {}\n", file);
    }
    write_json(command.report.json, part.report);
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
