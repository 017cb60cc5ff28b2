#include "scene_options.h"

#include <algorithm>
#include <limits>

#include "base/checked_cast.h"
#include "base/error.h"
#include "formats/scene_toml.h"
#include "parse_values.h"
#include "quality.h"
#include "scene/animation.h"
#include "scene/facts.h"
#include "scene/scene_camera.h"
#include "technique_options.h"

namespace voxilux {
namespace {

constexpr const char* kScene = "Scene";
constexpr const char* kSampling = "Sampling";
constexpr std::uint64_t kMostMib = std::numeric_limits<std::uint64_t>::max() >> 20;

void add_sampling_flags(CLI::App& command, SceneOptions& options) {
    command.add_option("--quality", options.quality, quality_help())->type_name("NAME")->group(kSampling);
    command.add_option("--spp", options.spp, "samples per pixel")->type_name("N")->group(kSampling);
    command
        .add_option("--iterations", options.iterations,
                    "iterations of photons: the samples per pixel of such a render")
        ->type_name("N")
        ->excludes("--spp")
        ->group(kSampling);
    add_photon_flags(command, options.photons);
    command.add_option("--ao-rays", options.ao_rays, "occlusion rays per sample")
        ->type_name("N")
        ->group(kSampling);
    command.add_option("--ao-radius", options.ao_radius, "reach of occlusion rays, in voxels")
        ->type_name("R")
        ->group(kSampling);
    command
        .add_option("--ao", options.ao,
                    "occlusion: brute (each pixel alone), hash (shared between pixels and frames) or auto")
        ->type_name("METHOD")
        ->group(kSampling);
    command
        .add_option("--traversal", options.traversal,
                    "structure that rays march through; the plan chooses one")
        ->type_name("NAME")
        ->group(kSampling);
    command.add_option("--seed", options.seed, "seed of every random stream")
        ->type_name("N")
        ->group(kSampling);
    command.add_option("--sequence", options.sequence, "sample sequence: sobol, halton or white")
        ->type_name("NAME")
        ->group(kSampling);
}

// The -D overrides, after those of the preset, so that they win.
std::vector<std::string> overrides_with_quality(const SceneOptions& options) {
    if (!options.quality) return options.overrides;
    std::vector<std::string> overrides = overrides_of(quality_named(*options.quality));
    overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
    return overrides;
}

bool needs_iterations(const Scene& scene, const SceneOptions& options) {
    const EffectRequest request =
        with_techniques(plan_request(options).effects, with_techniques(scene.settings, options.techniques));
    const EffectStates effects = decide_effects(measure_scene(scene), request);
    return std::ranges::any_of(effects, [](const EffectState& state) {
        return state.on && (state.effect == Effect::caustics || state.effect == Effect::indirect);
    });
}

// Samples of the preset in a scene that iterations of photons light, unless an override says how many.
void set_iterations_of_quality(const SceneOptions& options, Scene& scene) {
    if (!options.quality) return;
    const auto sets_samples = [](const std::string& text) { return text.starts_with("render.spp="); };
    if (std::ranges::none_of(options.overrides, sets_samples) && needs_iterations(scene, options))
        scene.settings.spp = quality_named(*options.quality).lamps.samples;
}

}  // namespace

void add_scene_flags(CLI::App& command, SceneOptions& options) {
    command.add_option("INPUT", options.input, "a .vox file, or a scene file .toml")
        ->required()
        ->type_name("");
    command.add_option("--size", options.size, "picture size in pixels")->type_name("WxH")->group(kScene);
    command
        .add_option("--camera", options.camera,
                    "frame it from three-quarter, front, back, left, right, top or iso")
        ->type_name("SIDE")
        ->group(kScene);
    command.add_option("--crop", options.crop, "render columns X0 to X1-1 and rows Y0 to Y1-1 only")
        ->type_name("X0,Y0,X1,Y1")
        ->group(kScene);
    command.add_option("--frame", options.frame, "one picture, of this frame of an animated scene")
        ->check([](const std::string& text) { return text.starts_with("-") ? "is not 0 or above" : ""; })
        ->type_name("N")
        ->group(kScene);
    command
        .add_option("--frames", options.frames,
                    "a picture for each frame from A to B, every Sth: x.png gives x.0001.png, ...")
        ->type_name("A-B[xS]")
        ->excludes("--frame")
        ->group(kScene);
    command.add_option("--effect", options.effects, "override the plan: on, off or auto; may repeat")
        ->type_name("NAME=STATE")
        ->take_all()
        ->allow_extra_args(false)
        ->group(kScene);
    command.add_option("--technique", options.techniques, technique_help())
        ->type_name("EFFECT=NAME")
        ->take_all()
        ->allow_extra_args(false)
        ->group(kScene);
    command
        .add_option("-D", options.overrides,
                    "set a key of the scene file, such as sun.elevation=10; may repeat")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->allow_extra_args(false)
        ->group(kScene);
    add_sampling_flags(command, options);
}

Scene load_scene_with(const SceneOptions& options) {
    // Flags are read before the file: a slip in a flag should not cost the loading of a large scene.
    std::optional<glm::ivec2> size;
    std::optional<View> view;
    std::optional<Sequence> sequence;
    if (options.size) size = parse_size("--size", *options.size);
    if (options.camera) view = parse_view(*options.camera);
    if (options.sequence) sequence = parse_sequence(*options.sequence);
    std::optional<AoMethod> ao;
    if (options.ao) ao = parse_ao_method(*options.ao);
    (void)with_photons({}, options.photons);
    (void)with_techniques(RenderSettings{}, options.techniques);

    Scene scene = load_scene(options.input, {.overrides = overrides_with_quality(options)});
    set_iterations_of_quality(options, scene);
    RenderSettings& settings = scene.settings;
    settings.size = size.value_or(settings.size);
    settings.spp = options.iterations.value_or(options.spp.value_or(settings.spp));
    settings.ao_rays = options.ao_rays.value_or(settings.ao_rays);
    settings.ao_radius = options.ao_radius.value_or(settings.ao_radius);
    settings.seed = options.seed.value_or(settings.seed);
    settings.sequence = sequence.value_or(settings.sequence);
    settings.ao.method = ao.value_or(settings.ao.method);
    settings.photons = with_photons(settings.photons, options.photons);
    settings = with_techniques(settings, options.techniques);
    if (view) {
        const double fov_y_deg = scene.camera ? scene.camera->fov_y_deg : kDefaultFovYDeg;
        scene.camera = framing_camera(scene, *view, fov_y_deg);
        scene.animation.camera_keys.clear();
    }
    return scene;
}

FrameList frames_to_render(const SceneOptions& options, const Scene& scene) {
    const std::optional<FrameRange> all = frames_of(scene);
    if (!options.frames) {
        const std::int64_t frame = options.frame.value_or(all.value_or(FrameRange{}).first);
        return {.first = frame, .last = frame};
    }
    const FrameList frames = parse_frames(*options.frames);
    if (!all)
        throw Error(ExitCode::usage,
                    "--frames: the scene is still; it needs [[camera.key]], [camera.turntable] "
                    "or an animated .vox file");
    return frames;
}

void request_frames(const Scene& scene, const FrameList& frames, PlanRequest& request) {
    request.frames = checked_cast<std::uint32_t>(frames.count(), "frames");
    request.moves_voxels = frames.count() > 1 && !scene.animation.files.empty();
}

void print_frame_note(const SceneOptions& options, const Scene& scene) {
    const std::optional<FrameRange> all = frames_of(scene);
    if (!all || options.frame || options.frames) return;
    fmt::print(stderr, "note: this is frame {0} of an animation; --frames {0}-{1} renders all {2}\n",
               all->first, all->last, all->last - all->first + 1);
}

PlanRequest plan_request(const SceneOptions& options) {
    PlanRequest request;
    for (const std::string& text : options.effects) {
        const EffectSwitch one = parse_effect_switch(text);
        request.effects.switches[one.effect] = one.choice;
    }
    if (options.traversal) request.traversal = traversal_named(*options.traversal);
    if (options.crop) request.crop = parse_window("--crop", *options.crop);
    request.memory_budget_bytes = std::min(options.memory_budget_mib, kMostMib) << 20;
    return request;
}

}  // namespace voxilux
