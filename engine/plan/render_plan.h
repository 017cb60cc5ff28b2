#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plan/device_limits.h"
#include "plan/effects.h"
#include "plan/plan_ao.h"
#include "plan/plan_paths.h"
#include "plan/plan_photons.h"
#include "plan/sample_set.h"
#include "plan/techniques.h"
#include "scene/facts.h"
#include "scene/lobe_weights.h"
#include "scene/scene.h"
#include "shared/gpu_types.h"
#include "world/build_fields.h"
#include "world/march_world.h"

namespace voxilux {

// What a plan needs to know of the built world.
struct WorldFacts {
    Traversal traversal = Traversal::wide;
    std::string traversal_reason;
    glm::ivec3 size{0};  // cells
    std::uint64_t root_bytes = 0;
    std::uint64_t node_bytes = 0;
    std::uint64_t leaf_bytes = 0;
    GrowthNeeds growth;
    LightFacts lights;
    std::uint64_t sphere_nodes = 0;  // of the hierarchy over spheres, 0 without one
    double sphere_visits = 0.0;      // of them that a ray visits

    bool operator==(const WorldFacts&) const = default;
};

[[nodiscard]] WorldFacts measure_world(const MarchWorld& march_world);

// Upper bounds of the rays that the whole render marches.
struct PlannedRays {
    std::uint64_t primary = 0;
    std::uint64_t ao = 0;
    std::uint64_t sun = 0;

    bool operator==(const PlannedRays&) const = default;
};

// The columns first.x <= x < end.x and the rows first.y <= y < end.y of an image, row 0 on top.
struct PixelWindow {
    glm::ivec2 first{0};
    glm::ivec2 end{0};

    bool operator==(const PixelWindow&) const = default;
};

// Everything that is decided before the first command: pure data, printable, comparable, made with no device,
// and never changed afterwards.
struct RenderPlan {
    RenderSettings settings;    // `size` is what is rendered: that of the crop window, where there is one
    SampleSet part;             // the samples to take; empty: the first settings.spp
    glm::ivec2 image_size{0};   // of the whole image, which the camera sees
    glm::ivec2 first_pixel{0};  // of the crop window in that image
    Projection projection = Projection::perspective;
    EffectStates effects;
    std::vector<ChosenTechnique> techniques;
    AoPlan ao;  // the default when the effect is off
    WorldFacts world;
    bool has_world_texels = false;  // shaders read the world's arrays as texels
    std::uint32_t material_count = 0;
    std::uint32_t sphere_count = 0;  // the ground included, which is the last one
    bool has_ground = false;
    std::uint32_t glass_spheres = 0;  // the first so many in the device's order
    bool has_glass_voxels = false;
    bool has_specular_spheres = false;     // of glass or metal
    bool has_rough = false;                // metal or glass
    bool shows_rough = false;              // as such, by paths that find all light
    std::vector<GainRow> gain_rows;        // of rough materials
    bool paths_find_sun_caustics = false;  // whatever finds those of emitters
    std::uint32_t sky_resolution = 0;      // of the atmosphere; 0: the sky is constant
    glm::ivec2 sky_image{0};               // columns and rows of an image of the sky; 0: there is none
    PhotonPlan photons;                    // all zero without caustics and indirect light
    PathPlan paths;                        // all zero without them
    bool sums_squares = false;             // of the beauty, for its variance
    bool sums_bias = false;                // of photons
    bool sums_guides = false;              // of the denoiser, in two halves
    bool catches_shadows = false;          // the ground, which shows nothing else
    bool sums_coverage = false;            // of the scene, before a background that is not the sky
    std::uint32_t film_tile_rows = 0;      // rows of one film tile: what one set of film buffers covers
    std::uint32_t film_tile_count = 0;
    std::uint32_t tile_rows = 0;  // most rows that one recording renders
    PlannedRays rays;
    std::vector<std::string> notes;    // what the image will lack, one line each
    std::vector<std::string> without;  // effects that were switched off although the scene calls for them

    bool operator==(const RenderPlan&) const = default;

    [[nodiscard]] bool has(Effect effect) const { return effects[static_cast<std::size_t>(effect)].on; }
    // Whether rays find spheres by a hierarchy, not one after the other.
    [[nodiscard]] bool has_sphere_tree() const {
        return has(Effect::spheres) && sphere_count > gpu::kFewSpheres;
    }
    [[nodiscard]] bool has_atmosphere() const { return has(Effect::sky) && sky_resolution != 0; }
    [[nodiscard]] bool has_sky_image() const { return has(Effect::sky) && sky_image.x != 0; }
    // Whether the light of the sky depends on the direction, and is a plane of each sample.
    [[nodiscard]] bool has_sky_plane() const { return has_atmosphere() || has_sky_image(); }
    // Whether paths aim at an image of the sky, as they do at emitters.
    [[nodiscard]] bool paths_aim_at_sky() const { return has_sky_image() && !settings.paths.plain; }
    [[nodiscard]] bool has_aerial() const { return has_atmosphere() && has(Effect::aerial); }
    // Whether each ray that leaves the scene traces the air by a path, instead of a look-up.
    [[nodiscard]] bool traces_air() const { return has_atmosphere() && settings.traces_air; }
    // Whether a technique of the plan has a property, such as &Technique::shares_samples.
    template <class Property>
    [[nodiscard]] bool any(Property property) const {
        return std::ranges::any_of(techniques, [&](const ChosenTechnique& chosen) {
            return std::invoke(property, *chosen.technique);
        });
    }
    // Whether an effect is on, and photons or paths find it.
    [[nodiscard]] bool is_by_photons(Effect effect) const { return finds(effect, &Technique::by_photons); }
    [[nodiscard]] bool is_by_paths(Effect effect) const { return finds(effect, &Technique::by_paths); }
    template <class Property>
    [[nodiscard]] bool finds(Effect effect, Property property) const {
        return has(effect) && std::ranges::any_of(techniques, [&](const ChosenTechnique& chosen) {
                   return chosen.technique->effect == effect && std::invoke(property, *chosen.technique);
               });
    }
    // Whether photons that came by mirrors or glass go on from diffuse surfaces, because paths do not find
    // that light.
    [[nodiscard]] bool sends_caustics_on() const {
        return is_by_photons(Effect::caustics) && is_by_paths(Effect::indirect);
    }
    // Whether the first ray of a path also takes the light of emitters that it meets, in place of a
    // surface-sampled ray of direct light.
    [[nodiscard]] bool paths_share_direct() const {
        return has(Effect::direct) && is_by_paths(Effect::indirect) && !settings.paths.plain;
    }
    // Whether paths need the normal of the visible point: to weigh what they meet first, or to aim at the
    // sun or at an image of the sky. What rough visible points need instead is in its place.
    [[nodiscard]] bool paths_keep_normals() const {
        return shows_rough || paths_share_direct() || paths_aim_at_sky() ||
               (paths_find_sun_caustics && has(Effect::sun));
    }
    // Invocations that trace the paths of `rows` rows.
    [[nodiscard]] std::uint32_t path_lanes(std::uint32_t rows) const {
        const std::uint64_t pixels = std::uint64_t{rows} * static_cast<std::uint64_t>(settings.size.x);
        return static_cast<std::uint32_t>((pixels + paths.per_lane - 1) / paths.per_lane);
    }
    // Whether samples of a pixel are independent of each other, so that their variance tells the error of
    // their mean. Those of a low-discrepancy sequence are not: their mean errs less. (Its two halves are.)
    [[nodiscard]] bool has_independent_samples() const {
        return settings.sequence == Sequence::white || any(&Technique::independent_samples);
    }
    // Samples per pixel that this render takes: those of its part.
    [[nodiscard]] std::uint32_t samples() const { return part.empty() ? settings.spp : part.size(); }
    // Whether the film is denoised when it is complete. A part is not a whole film.
    [[nodiscard]] bool is_denoised() const { return sums_guides && part.empty(); }
    // Whether the render itself has to find the first radius of photons.
    [[nodiscard]] bool needs_pilot() const {
        return photons.runs() && any(&Technique::needs_pilot) && !settings.photons.radius;
    }
    [[nodiscard]] std::uint64_t tile_pixels() const {
        return std::uint64_t{tile_rows} * static_cast<std::uint64_t>(settings.size.x);
    }
    [[nodiscard]] std::uint64_t tile_beams() const {
        return std::uint64_t{gpu::beam_count(tile_rows)} *
               gpu::beam_count(static_cast<gpu::uint>(settings.size.x));
    }
    [[nodiscard]] std::uint64_t film_tile_pixels() const {
        return std::uint64_t{film_tile_rows} * static_cast<std::uint64_t>(settings.size.x);
    }
};

struct PlanRequest {
    EffectRequest effects;
    std::uint64_t memory_budget_bytes = 0;  // 0: no limit
    std::uint64_t photon_store_bytes = 0;   // that a run of photons may take; 0: as much as a binding
    std::optional<PixelWindow> crop;        // render these pixels of the image only
    std::optional<Traversal> traversal;     // the plan chooses when there is none
    SampleSet part;                         // the samples to take; empty: the first settings.spp
    std::uint32_t frames = 1;               // that will be rendered
    bool moves_voxels = false;              // between these frames
    bool wants_error = false;               // an error target decides when to stop
    bool wants_denoised = false;            // the image will be denoised
    bool leaves_room = false;               // worlds have room for what edits add
};

// Throws Error(input_refused) for settings that are out of range or exclude each other, and Error(usage) for
// a crop outside the image or a part where techniques allow none. Memory is not checked: see
// plan_within_memory().
[[nodiscard]] RenderPlan plan_render(const Scene& scene, const SceneFacts& facts, const WorldFacts& world,
                                     const PlanRequest& request, const DeviceLimits& limits);

// Whether photons of such a plan serve caustics alone and may start towards mirrors and glass, so that the
// facts of its world should tell where (LightFacts::aims).
[[nodiscard]] bool aims_photons(const Scene& scene, const SceneFacts& facts, const PlanRequest& request);

// Variants of a plan, made by the same rules. No image is made of the first two, which have neither AOVs nor
// sums of squares or bias.

// The same samples without an effect.
[[nodiscard]] RenderPlan plan_without(RenderPlan plan, Effect effect);
// One iteration with kernels of this radius, voxels, in which each pixel counts the photons in its own.
[[nodiscard]] RenderPlan plan_counting(RenderPlan plan, double radius);
// The plan with the radius of the first iteration, voxels, that a pilot has found.
[[nodiscard]] RenderPlan plan_with_radius(RenderPlan plan, double radius);
// A strip of the image.
[[nodiscard]] RenderPlan plan_of_rows(RenderPlan plan, std::uint32_t rows);

}  // namespace voxilux
