#include "scene_options.h"

#include <algorithm>

#include "base/checked_cast.h"
#include "base/error.h"
#include "base/print.h"
#include "in_range.h"
#include "parse_values.h"
#include "scene/animation.h"
#include "scene/scene_camera.h"
#include "scene/settings.h"
#include "shared_flags.h"

namespace voxilux {
namespace {

// Stores a value in a member of the settings.
template <class T>
std::function<void(const T&)> change(SettingsChanges& changes, T RenderSettings::*member) {
    return [&changes, member](const T& value) {
        changes.push_back([=](RenderSettings& settings) { settings.*member = value; });
    };
}

// Takes a number in the range of the setting `key`.
template <class T>
std::function<void(const T&)> checked(const char* flag, const char* key, std::function<void(const T&)> take) {
    return [=](const T& value) { take(in_range<RenderSettings>(flag, key, value)); };
}

// The same for a setting of photons, given as text or as a number.
template <class T, class Value, class Check>
std::function<void(const Value&)> change_photons(SettingsChanges& changes, T PhotonSettings::*member,
                                                 Check check) {
    return [&changes, member, check](const Value& given) {
        const T value = check(given);
        changes.push_back([=](RenderSettings& settings) { settings.photons.*member = value; });
    };
}

std::string traversal_names() {
    std::string text;
    for (std::size_t i = 0; i < kTraversalCount; ++i)
        text += fmt::format("{}{}", i == 0 ? "" : "|", name_of(static_cast<Traversal>(i)));
    return text;
}

void add_sampling_flags(Flags& flags, SceneOptions& options) {
    SettingsChanges& changes = options.changes;
    flags.begin_group("Sampling");
    flags.add_parsed(
        "--quality", quality_names(), options.quality,
        [](const std::string& name) { return &quality_named(name); }, quality_help());
    const std::function<void(const std::uint32_t&)> take_spp = [&](std::uint32_t spp) { options.spp = spp; };
    flags.on("--spp", "N", checked("--spp", "spp", take_spp), "samples per pixel");
    flags
        .on("--iterations", "N", checked("--iterations", "spp", take_spp),
            "iterations of photons: the samples per pixel of such a render")
        .excludes("--spp");
    add_photon_flags(flags, changes);
    flags.on("--ao-rays", "N", checked("--ao-rays", "ao_rays", change(changes, &RenderSettings::ao_rays)),
             "occlusion rays per sample");
    flags.on("--ao-radius", "R",
             checked("--ao-radius", "ao_radius", change(changes, &RenderSettings::ao_radius)),
             "reach of occlusion rays, in voxels");
    flags.on<std::string>(
        "--ao", "brute|hash|auto",
        [&changes](const std::string& name) {
            changes.push_back(
                [method = parse_ao_method(name)](RenderSettings& settings) { settings.ao.method = method; });
        },
        "occlusion: of each pixel alone, or shared between pixels and frames");
    flags.add_parsed("--traversal", traversal_names(), options.request.traversal, traversal_named,
                     "structure that rays march through; the plan chooses one");
    flags.on("--seed", "N", change(changes, &RenderSettings::seed), "seed of every random stream");
    flags.on<std::string>(
        "--sequence", "sobol|halton|white",
        [take = change(changes, &RenderSettings::sequence)](const std::string& name) {
            take(parse_sequence(name));
        },
        "sample sequence");
}

void add_projection_flags(Flags& flags, SceneOptions& options) {
    flags.add_parsed("--projection", fmt::format("{}", fmt::join(kProjectionNames, "|")), options.projection,
                     parse_projection, "of the camera");
    flags.on<double>(
        "--pixels-per-voxel", "N",
        [&options](double pixels) {
            options.pixels_per_voxel =
                in_range<CameraSettings>("--pixels-per-voxel", "pixels_per_voxel", pixels);
        },
        "a sprite: an orthographic picture of this scale, as large as the scene unless --size is given");
}

void add_turntable_flags(Flags& flags, SceneOptions& options) {
    flags
        .on<std::int64_t>(
            "--turntable", "N",
            [&options](std::int64_t frames) {
                options.turntable = in_range<Turntable>("--turntable", "frames", frames);
            },
            "N pictures of a whole turn, numbered as frames")
        .excludes("--viewpoint");
    flags.add_parsed("--turn", fmt::format("{}", fmt::join(kTurnedNames, "|")), options.turned, parse_turned,
                     "what turns; where the model does, light and camera stay");
}

constexpr const char* kCameraValue = "front|back|left|right|top|bottom|iso|three-quarter|N";

Flag add_input_flag(Flags& flags, SceneOptions& options, PicturesOf pictures) {
    if (pictures != PicturesOf::inputs)
        return flags.add("INPUT", "", options.input,
                         "a .vox file, a scene file .toml, a mesh, voxels of another format (see convert), "
                         "or - for standard input");
    return flags.on<std::vector<std::string>>(
        "INPUT", "",
        [&options](const std::vector<std::string>& files) {
            options.inputs = files;
            options.input = files.front();
        },
        "a .vox file, a scene file .toml, a mesh, voxels of another format (see convert), or - for standard "
        "input; several give a "
        "picture of each");
}

void add_camera_flag(Flags& flags, SceneOptions& options, PicturesOf pictures) {
    const std::string help = "a side that frames it, or the number of a camera in the file";
    if (pictures != PicturesOf::inputs) {
        flags.add_parsed("--camera", kCameraValue, options.camera, parse_camera, help);
        return;
    }
    flags.on<std::vector<std::string>>(
        "--camera", kCameraValue,
        [&options](const std::vector<std::string>& names) {
            options.cameras.clear();
            for (const std::string& name : names)
                options.cameras.push_back(parse_camera(name));
            options.camera = options.cameras.front();
        },
        help + "; may repeat");
}

void add_background_flags(Flags& flags, SceneOptions& options) {
    flags.add_parsed("--background", "COLOR|sky", options.background, parse_background,
                     "a colour behind the scene, #rrggbb, or the sky");
    flags
        .on_switch(
            "--transparent", [&options] { options.background = Background{.shown = Backdrop::transparent}; },
            "nothing behind the scene: a PNG or EXR with alpha; --alpha without a number is the same")
        .excludes("--background");
    flags.add_switch("--ignore-file-settings", options.ignores_file_settings,
                     "leave out light, ground, background, lens and film of a .vox file");
}

}  // namespace

void add_photon_flags(Flags& flags, SettingsChanges& changes) {
    const auto checked_count = [](std::int64_t count) {
        return static_cast<std::uint32_t>(in_range<PhotonSettings>("--photons", "count", count));
    };
    const auto checked_alpha = [](double alpha) {
        return in_range<PhotonSettings>("--alpha", "alpha", alpha);
    };
    flags.on("--photons", "N",
             change_photons<std::uint32_t, std::int64_t>(changes, &PhotonSettings::count, checked_count),
             "photons of an iteration; 0: as many as the picture has pixels");
    flags.on("--radius", "R",
             change_photons<std::optional<double>, std::string>(changes, &PhotonSettings::radius,
                                                                parse_photon_radius),
             "radius of photons in the first iteration, in voxels, or auto");
    flags.on("--alpha", "A", change_photons<double, double>(changes, &PhotonSettings::alpha, checked_alpha),
             "how slowly that radius shrinks, above 0 and up to 1, where it stays");
}

Flag add_scene_flags(Flags& flags, SceneOptions& options, PicturesOf pictures) {
    PlanRequest& request = options.request;
    const Flag input = add_input_flag(flags, options, pictures);
    flags.begin_group("Scene");
    flags.on<std::string>(
        "--size", "WxH",
        [&options, take = change(options.changes, &RenderSettings::size)](const std::string& text) {
            take(parse_size("--size", text));
            options.names_size = true;
        },
        "picture size in pixels");
    add_mesh_flags(flags, options.grid);
    add_camera_flag(flags, options, pictures);
    flags
        .add_parsed("--viewpoint", "X,Y,Z,YAW,PITCH,FOV", options.viewpoint, parse_viewpoint,
                    "place and direction of the camera, in voxels and degrees, as the window prints them")
        .excludes("--camera");
    add_projection_flags(flags, options);
    add_background_flags(flags, options);
    flags.add_parsed("--crop", "X0,Y0,X1,Y1", request.crop, parse_window,
                     "render columns X0 to X1-1 and rows Y0 to Y1-1 only");
    flags.add("--frame", "N", options.frame, "one picture, of this frame of an animated scene").from_zero();
    if (pictures != PicturesOf::scene)
        flags
            .add_parsed("--frames", "A-B[xS]", options.frames, parse_frames,
                        "a picture for each frame from A to B, every Sth: x.png gives x.0001.png, ...")
            .excludes("--frame");
    if (pictures != PicturesOf::scene) add_turntable_flags(flags, options);
    flags.on<std::vector<std::string>>(
        "--effect", "NAME=STATE",
        [&request](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
                const EffectSwitch one = parse_effect_switch(text);
                request.effects.switches[one.effect] = one.choice;
            }
        },
        "override the plan: on, off or auto; may repeat");
    flags.on<std::vector<std::string>>(
        "--technique", "EFFECT=NAME",
        [&options](const std::vector<std::string>& texts) {
            for (const std::string& text : texts)
                options.techniques.push_back(parse_technique(text));
            RenderSettings settings;
            choose_techniques(options.techniques, settings);
        },
        technique_help());
    flags.add("-D", "KEY=VALUE", options.overrides,
              "set a key of the scene file, such as sun.elevation=10; may repeat");
    add_sampling_flags(flags, options);
    return input;
}

bool asks_for_frames(const SceneOptions& options) {
    return options.frames || (options.turntable && !options.frame);
}

FrameList frames_asked_for(const SceneOptions& options) {
    if (options.frames) return *options.frames;
    if (!asks_for_frames(options)) return {};
    return {.first = 1, .last = *options.turntable, .is_sequence = true};
}

FrameList frames_to_render(const SceneOptions& options, const Scene& scene) {
    const std::optional<FrameRange> all = frames_of(scene);
    if (!asks_for_frames(options)) {
        const std::int64_t frame = options.frame.value_or(all.value_or(FrameRange{}).first);
        return {.first = frame, .last = frame};
    }
    if (options.frames && !all)
        throw Error(ExitCode::usage,
                    "--frames: the scene is still; it needs [[camera.key]], [camera.turntable] "
                    "or an animated .vox file");
    return frames_asked_for(options);
}

void request_frames(const Scene& scene, const FrameList& frames, PlanRequest& request) {
    request.frames = checked_cast<std::uint32_t>(frames.count(), "frames");
    request.moves_voxels = frames.count() > 1 && !scene.animation.files.empty();
}

void print_frame_note(const SceneOptions& options, const Scene& scene) {
    const std::optional<FrameRange> all = frames_of(scene);
    if (!all || options.frame || options.frames || options.turntable) return;
    print_message("note: this is frame {0} of an animation; --frames {0}-{1} renders all {2}\n", all->first,
                  all->last, all->last - all->first + 1);
}

}  // namespace voxilux
