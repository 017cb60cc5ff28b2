#include "plan/render_plan.h"

#include <algorithm>
#include <limits>

#include "base/checked_cast.h"
#include "base/error.h"
#include "plan/film_planes.h"
#include "plan/plan_notes.h"
#include "scene/atmosphere.h"
#include "scene/lobe_weights.h"
#include "shared/alias.h"
#include "shared/gpu_types.h"

namespace voxilux {
namespace {

// Pixels of one film tile: small enough that every buffer of a film tile stays far below 128 MiB, large
// enough that images up to 1024 x 1024 are one film tile.
constexpr std::uint64_t kFilmTilePixels = std::uint64_t{1} << 20;
constexpr std::uint64_t kMaxImagePixels =
    (std::uint64_t{1} << 32) - 1;  // pixel numbers are 32 bits in the shaders
constexpr int kMaxImageSide =
    1 << 17;  // pixels; the limit of image files, and few enough workgroups in a row
constexpr std::uint32_t kGroupEdge = 8;

void check_settings(const RenderSettings& settings) {
    const auto refuse = [](const std::string& what) { throw Error(ExitCode::input_refused, what); };
    if (settings.size.x < 1 || settings.size.y < 1)
        refuse(fmt::format("picture size {}x{}: both sides must be at least 1", settings.size.x,
                           settings.size.y));
    if (static_cast<std::uint64_t>(settings.size.x) * static_cast<std::uint64_t>(settings.size.y) >
        kMaxImagePixels)
        refuse(fmt::format("picture size {}x{}: over 2^32 pixels", settings.size.x, settings.size.y));
    if (settings.size.x > kMaxImageSide || settings.size.y > kMaxImageSide)
        refuse(fmt::format("picture size {}x{}: no side may be over {} pixels", settings.size.x,
                           settings.size.y, kMaxImageSide));
    if (settings.spp < 1) refuse("spp must be at least 1");
    if (settings.ao_rays < 1) refuse("ao_rays must be at least 1");
    if (!(settings.ao_radius > 0.0f)) refuse(fmt::format("ao_radius {} must be above 0", settings.ao_radius));
}

std::uint64_t pixels_of(const RenderSettings& settings) {
    return static_cast<std::uint64_t>(settings.size.x) * static_cast<std::uint64_t>(settings.size.y);
}

void place_window(RenderPlan& plan, const std::optional<PixelWindow>& crop) {
    const glm::ivec2 size = plan.settings.size;
    plan.image_size = size;
    if (!crop) return;
    const auto [first, end] = *crop;
    const bool is_inside =
        glm::all(glm::greaterThanEqual(first, glm::ivec2(0))) && glm::all(glm::lessThanEqual(end, size));
    if (!is_inside || !glm::all(glm::lessThan(first, end))) {
        throw Error(ExitCode::usage,
                    fmt::format("the crop {},{},{},{} is empty or leaves the picture of {}x{}", first.x,
                                first.y, end.x, end.y, size.x, size.y));
    }
    plan.first_pixel = first;
    plan.settings.size = end - first;
}

void check_part(const RenderPlan& plan) {
    if (plan.part.empty()) return;
    for (const ChosenTechnique& chosen : plan.techniques) {
        if (!chosen.technique->mergeable())
            throw Error(ExitCode::usage,
                        fmt::format("samples cannot be rendered in parts: {}", chosen.technique->state));
    }
}

void check_sky_image(glm::ivec2 size, const DeviceLimits& limits) {
    const auto words =
        gpu::kAliasWords * static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
    if (words > limits.max_texels)
        throw Error(
            ExitCode::out_of_memory,
            fmt::format("the image of the sky, {}x{}, is too large for {}: its table may have {} words",
                        size.x, size.y, limits.name, limits.max_texels));
}

// The ground shows a shadow as the light that is missing, which is known only under a constant sky.
void check_shadows(const RenderPlan& plan, const Scene& scene) {
    if (!plan.catches_shadows) return;
    if (!plan.sums_coverage)
        throw Error(ExitCode::input_refused,
                    "[ground] 'shadow_only' needs a background: --alpha, or --background COLOR");
    if (scene.sky.model != SkyModel::constant)
        throw Error(ExitCode::input_refused,
                    fmt::format("[ground] 'shadow_only' needs a constant sky, not an {}",
                                kSkyModelNames[static_cast<std::size_t>(scene.sky.model)]));
}

// Paths that find caustics find all light.
void check_paths(const RenderPlan& plan) {
    if (plan.is_by_paths(Effect::caustics) && !plan.is_by_paths(Effect::indirect))
        throw Error(ExitCode::input_refused,
                    "caustics by paths need indirect light by paths; use --technique indirect=paths, too");
}

// Chooses the techniques of the effects that are on, and clears what belongs to the others.
void decide_techniques(RenderPlan& plan) {
    if (!plan.has(Effect::ao)) plan.ao = {};
    plan.shows_rough = shows_rough(plan.effects, plan.settings, plan.has_rough);
    plan.techniques =
        choose_techniques(plan.effects, plan.ao, plan.settings, plan.has_specular_spheres, plan.has_rough);
    if (plan.has_atmosphere()) plan.techniques.push_back(choose_sky_technique(plan.settings));
    plan.paths_find_sun_caustics =
        plan.has(Effect::caustics) &&
        (plan.is_by_paths(Effect::caustics) ||
         leaves_sun_to_paths(plan.effects, plan.settings, plan.has_specular_spheres));
    if (!plan.any(&Technique::by_photons)) plan.photons = {};
    if (!plan.any(&Technique::by_paths)) plan.paths = {};
}

// What the film sums besides the image: for errors and for the denoiser.
void decide_sums(RenderPlan& plan, const PlanRequest& request) {
    const bool decides = request.wants_error && plan.has_independent_samples();
    plan.sums_squares = !plan.any(&Technique::shares_samples) && (plan.has(Effect::aov) || decides);
    plan.sums_bias = plan.any(&Technique::tells_bias) && (plan.has(Effect::aov) || request.wants_error);
    const bool has_halves = plan.samples() > 1 || !plan.part.empty();  // parts add up
    plan.sums_guides = request.wants_denoised && has_halves && !plan.any(&Technique::shares_samples);
}

// `max_rows`: most rows of one dispatch.
void split_image(RenderPlan& plan, std::uint32_t max_rows) {
    const auto width = static_cast<std::uint64_t>(plan.settings.size.x);
    const auto height = static_cast<std::uint32_t>(plan.settings.size.y);
    const std::uint64_t rows =
        std::max<std::uint64_t>(kFilmTilePixels / width / kGroupEdge * kGroupEdge, kGroupEdge);
    plan.film_tile_rows = plan.any(&Technique::whole_frame)
                              ? height
                              : static_cast<std::uint32_t>(std::min<std::uint64_t>(rows, height));
    plan.film_tile_count = (height + plan.film_tile_rows - 1) / plan.film_tile_rows;
    plan.tile_rows = std::min(plan.film_tile_rows, max_rows);  // groups may be one row high
}

void count_rays(RenderPlan& plan) {
    const std::uint64_t samples = static_cast<std::uint64_t>(plan.settings.size.x) *
                                  static_cast<std::uint64_t>(plan.settings.size.y) * plan.samples();
    plan.rays.primary = plan.has(Effect::voxels) || plan.has(Effect::spheres) ? samples : 0;
    const std::uint64_t max_samples = std::numeric_limits<std::uint64_t>::max() / plan.settings.ao_rays;
    plan.rays.ao = plan.has(Effect::ao) ? std::min(samples, max_samples) * plan.settings.ao_rays : 0;
    plan.rays.sun = plan.has(Effect::sun) ? samples : 0;
}

// What the passes have to know of the scene.
void take_scene(RenderPlan& plan, const Scene& scene, const SceneFacts& facts, const WorldFacts& world,
                const DeviceLimits& limits) {
    plan.world = world;
    plan.has_world_texels =
        loads_texels(limits, std::max({world.root_bytes, world.node_bytes, world.leaf_bytes}));
    plan.material_count = checked_cast<std::uint32_t>(
        std::max<std::size_t>(scene.materials.size() + scene.ground.count(), 1), "materials");
    plan.sphere_count = checked_cast<std::uint32_t>(scene.spheres.size() + scene.ground.count(), "spheres");
    plan.has_ground = scene.ground.on;
    plan.sums_coverage = scene.background.shown != Backdrop::sky;
    plan.catches_shadows = plan.has_ground && scene.ground.shadow_only;
    check_shadows(plan, scene);
    plan.glass_spheres = glass_sphere_count(scene);
    plan.has_glass_voxels = facts.has_glass && facts.has_voxels;
    plan.has_specular_spheres = facts.has_specular_spheres;
    plan.has_rough = facts.has_rough;
    if (facts.has_rough) plan.gain_rows = gain_rows(scene);
    if (facts.has_atmosphere) plan.sky_resolution = scene.sky.resolution;
    plan.sky_image = facts.sky_image;
    check_sky_image(plan.sky_image, limits);
}

}  // namespace

WorldFacts measure_world(const MarchWorld& march_world) {
    // A buffer has at least one word, also where a level has no cells.
    const auto bytes = [](const std::vector<std::uint32_t>& words) {
        return std::max<std::uint64_t>(words.size(), 1) * sizeof(std::uint32_t);
    };
    return {.traversal = march_world.traversal,
            .size = march_world.size(),
            .root_bytes = bytes(march_world.roots),
            .node_bytes = bytes(march_world.nodes),
            .leaf_bytes = bytes(march_world.leaves),
            .growth = growth_needs(march_world)};
}

std::vector<FilmPlane> film_planes(const RenderPlan& plan) {
    std::vector<FilmPlane> planes = {{"beauty_a", 3}, {"beauty_b", 3}};
    if (plan.sums_squares) planes.push_back({"squares", 3});
    if (plan.sums_bias) planes.insert(planes.end(), {{"bias_a", 3}, {"bias_b", 3}});
    if (plan.sums_coverage) planes.push_back({"coverage", 1});
    if (plan.sums_guides) {
        for (const std::string half : {"_a", "_b"}) {
            for (const char* guide : {"guide_sharp", "guide_albedo", "guide_normal"})
                planes.push_back({guide + half, 3});
            planes.push_back({"guide_offset" + half, 1});
        }
    }
    if (!plan.has(Effect::aov)) return planes;
    planes.push_back({"albedo", 3});
    planes.push_back({"normal", 3});
    if (plan.has(Effect::ao)) planes.push_back({"ao", 1});
    if (plan.has(Effect::sun)) planes.push_back({"sun", 1});
    return planes;
}

std::string film_buffer(const std::string& plane, std::uint32_t film_tile) {
    return fmt::format("film.{}.{}", plane, film_tile);
}

RenderPlan plan_render(const Scene& scene, const SceneFacts& facts, const WorldFacts& world,
                       const PlanRequest& request, const DeviceLimits& limits) {
    check_settings(scene.settings);
    RenderPlan plan;
    plan.settings = scene.settings;
    plan.part = request.part;
    place_window(plan, request.crop);
    if (scene.camera) plan.projection = scene.camera->projection;
    EffectRequest wanted = with_techniques(request.effects, plan.settings);
    wanted.is_perspective = plan.projection == Projection::perspective;
    plan.effects = decide_effects(facts, wanted);
    take_scene(plan, scene, facts, world, limits);
    plan.ao = plan_ao(plan.settings, {.has_voxels = plan.has(Effect::voxels),
                                      .world_size = world.size,
                                      .pixels = pixels_of(plan.settings),
                                      .max_rows = limits.max_groups[1],
                                      .frames = request.frames,
                                      .moves_voxels = request.moves_voxels,
                                      .is_perspective = plan.projection == Projection::perspective,
                                      .is_cpu = limits.is_cpu,
                                      .wants_error = request.wants_error});
    decide_techniques(plan);
    if (plan.any(&Technique::by_photons)) {
        plan.photons =
            plan_photons(plan.settings.photons,
                         {.lights = world.lights,
                          .has_emitters = plan.has(Effect::emission),
                          .has_sun = plan.has(Effect::sun) && !plan.paths_find_sun_caustics,
                          .keeps_indirect = plan.is_by_photons(Effect::indirect) || plan.sends_caustics_on(),
                          .sun_irradiance = sunlight(scene),
                          .pixels = pixels_of(plan.settings),
                          .max_albedo = facts.max_albedo,
                          .sphere_visits = world.sphere_visits,
                          .has_voxels = plan.has(Effect::voxels),
                          .store_bytes = request.photon_store_bytes != 0 ? request.photon_store_bytes
                                                                         : limits.max_binding_bytes},
                         limits);
    }
    if (plan.any(&Technique::by_paths))
        plan.paths = plan_paths({.aims_at_sky = plan.paths_aim_at_sky(),
                                 .max_albedo = facts.max_albedo,
                                 .sphere_visits = world.sphere_visits,
                                 .has_voxels = plan.has(Effect::voxels)},
                                limits);
    check_paths(plan);
    check_part(plan);
    decide_sums(plan, request);
    split_image(plan, limits.max_groups[1]);
    count_rays(plan);
    add_notes(plan, facts);
    return plan;
}

bool aims_photons(const Scene& scene, const SceneFacts& facts, const PlanRequest& request) {
    if (!scene.settings.photons.aim) return false;
    RenderPlan plan;
    plan.settings = scene.settings;
    plan.effects = decide_effects(facts, with_techniques(request.effects, plan.settings));
    plan.has_specular_spheres = facts.has_specular_spheres;
    plan.has_rough = facts.has_rough;
    decide_techniques(plan);
    return plan.is_by_photons(Effect::caustics) && !plan.is_by_photons(Effect::indirect);
}

RenderPlan plan_without(RenderPlan plan, Effect effect) {
    const auto leave_out = [&](Effect one) { plan.effects[static_cast<std::size_t>(one)].on = false; };
    if (effect == Effect::indirect && plan.is_by_paths(Effect::caustics)) leave_out(Effect::caustics);
    leave_out(effect);
    leave_out(Effect::aov);
    decide_techniques(plan);
    decide_sums(plan, {});
    return plan;
}

RenderPlan plan_counting(RenderPlan plan, double radius) {
    plan.settings.spp = 1;
    plan.part = {};  // every part finds the same
    plan.settings.photons.classic = true;
    plan.settings.photons.scatter = false;
    plan.settings.photons.alpha = 1.0;  // with a constant radius, a pixel's count is that of its photons
    plan = plan_without(plan_with_radius(std::move(plan), radius), Effect::aov);
    for (const Effect one : {Effect::ao, Effect::sky, Effect::aerial, Effect::direct})
        plan.effects[static_cast<std::size_t>(one)].on = false;
    plan.paths = {};
    return plan;
}

RenderPlan plan_with_radius(RenderPlan plan, double radius) {
    plan.photons.radius = radius;
    return plan;
}

RenderPlan plan_of_rows(RenderPlan plan, std::uint32_t rows) {
    plan.settings.size.y = static_cast<int>(rows);
    split_image(plan, plan.tile_rows);
    return plan;
}

}  // namespace voxilux
