#include "plan/plan_lists.h"

#include <algorithm>
#include <functional>

#include "plan/film_planes.h"
#include "shared/alias.h"
#include "shared/gpu_types.h"
#include "shared/photon_cell.h"
#include "shared/photon_types.h"
#include "shared/tally.h"

namespace voxilux {
namespace {

// Slices that one sample of the whole picture is cut into when none is made smaller.
std::uint64_t slices_of_a_sample(const RenderPlan& plan) {
    const auto cut = [&](std::uint32_t rows) { return (rows + plan.slice_rows - 1) / plan.slice_rows; };
    const auto height = static_cast<std::uint32_t>(plan.settings.size.y);
    const std::uint32_t last_rows = height - (plan.band_count - 1) * plan.band_rows;
    return std::uint64_t{plan.band_count - 1} * cut(plan.band_rows) + cut(last_rows);
}

using AddPass = std::function<void(bool, const char*, std::uint64_t)>;

void list_ao_passes(const RenderPlan& plan, std::uint64_t slices, const AddPass& add) {
    const AoSettings& ao = plan.settings.ao;
    const bool cells = plan.has_ao_cells();
    add(plan.has(Effect::ao) && !cells, "ao.trace", slices);
    add(cells && plan.ao.ages, "ao.age", 1);
    add(cells && !plan.ao.merged && !plan.ao.reprojects, "ao.lookup", slices);
    add(cells && !plan.ao.merged && plan.ao.reprojects, "ao.reproject", slices);
    add(cells && !plan.ao.merged && plan.ao.reprojects, "ao.search", slices);
    add(cells, "ao.sample", slices);
    add(cells, "ao.resolve", slices);
    add(cells, "ao.filter", slices * ao.filter);
}

void list_photon_passes(const RenderPlan& plan, std::uint64_t slices, const AddPass& add) {
    const bool on = plan.has_photons();
    add(on, "photon.mark", slices);
    add(on, "photon.emit", slices);
    add(on, "photon.trace", slices);
    const bool scatter = plan.settings.photons.scatter;
    add(on && scatter, "photon.point", slices);
    add(on, "photon.scan", 3 * slices);
    add(on && scatter, "photon.place", slices);
    add(on && scatter, "photon.splat", slices);
    add(on && scatter, "photon.resolve", slices);
    add(on && !scatter, "photon.sort", slices);
    add(on && !scatter, "photon.gather", slices);
}

void list_photon_buffers(RenderPlan& plan) {
    if (!plan.has_photons()) return;
    const auto list = [&](const char* name, std::uint64_t bytes) {
        plan.buffers.push_back({name, bytes, false});
    };
    const PhotonPlan& photons = plan.photons;
    list("photon.frame", sizeof(gpu::PhotonParams));
    list("photon.rays", photons.count() * sizeof(gpu::PhotonStart));
    list("photon.head", sizeof(gpu::PhotonHead));
    list("photon.stored", photons.capacity * sizeof(gpu::StoredPhoton));
    list("photon.wanted", gpu::mark_words(photons.buckets) * sizeof(gpu::uint));
    list("photon.counts", photons.buckets * sizeof(gpu::uint));
    list("photon.runs", gpu::scan_runs(photons.buckets) * sizeof(gpu::uint));
    list("photon.starts", (photons.buckets + 1) * sizeof(gpu::uint));
    const std::uint64_t pixels = plan.slice_pixels();
    list("photon.light", pixels * sizeof(gpu::vec3));
    list("photon.narrow", pixels * sizeof(gpu::vec3));
    if (plan.sums_bias) list("photon.bias", pixels * sizeof(gpu::vec3));
    if (plan.settings.photons.classic)
        plan.buffers.push_back({"photon.radii", pixels * sizeof(gpu::PixelRadius), true});
    if (plan.settings.photons.scatter) {
        list("photon.ranks", pixels * sizeof(gpu::uint));
        list("photon.points", pixels * sizeof(gpu::PhotonPoint));
        list("photon.totals", pixels * 6 * sizeof(std::uint64_t));
    } else {
        list("photon.sorted", photons.capacity * sizeof(gpu::SortedPhoton));
    }
}

void list_ao_buffers(RenderPlan& plan) {
    const auto list = [&](const char* name, std::uint64_t bytes, bool is_persistent) {
        plan.buffers.push_back({name, bytes, is_persistent});
    };
    const std::uint64_t pixels = plan.slice_pixels();
    if (plan.has(Effect::ao)) list("ao.open", pixels * sizeof(float), false);
    if (!plan.has_ao_cells()) return;
    list("ao.frame", sizeof(gpu::AoParams), false);
    list("ao.keys", std::uint64_t{plan.ao.slots} * 8, true);
    list("ao.samples", std::uint64_t{plan.ao.slots} * 8, true);
    list("ao.opens", std::uint64_t{plan.ao.slots} * 8, true);
    list("ao.touched", std::uint64_t{plan.ao.slots} * 4, true);
    list("ao.slots_even", pixels * sizeof(gpu::uint), true);
    const bool reprojects = plan.ao.reprojects;
    if (reprojects) list("ao.slots_odd", pixels * sizeof(gpu::uint), true);
    if (reprojects && !plan.ao.merged)
        list("ao.missed", sizeof(gpu::AoMissed) + pixels * sizeof(gpu::uint), false);
    list("ao.own", pixels * sizeof(float), false);
    if (plan.settings.ao.filter == 0) return;
    list("ao.variance", pixels * sizeof(float), false);
    list("ao.filtered", pixels * sizeof(float), false);
    list("ao.filtered_variance", pixels * sizeof(float), false);
}

}  // namespace

void list_passes(RenderPlan& plan) {
    const std::uint64_t slices = slices_of_a_sample(plan) * plan.samples();
    const auto add = [&](bool on, const char* label, std::uint64_t count) {
        if (on && count > 0) plan.passes.push_back({label, count});
    };
    add(plan.has(Effect::voxels), "world.grow", plan.world.growth.steps);
    add(plan.has(Effect::voxels), "primary.beam", slices);
    add(plan.has(Effect::voxels), "primary.march", slices);
    add(plan.has(Effect::spheres), "sphere.trace", slices);
    add(plan.has(Effect::specular), "specular.trace", slices);
    list_ao_passes(plan, slices, add);
    add(plan.has(Effect::sun), "sun.trace", slices);
    add(plan.has(Effect::direct), "direct.trace", slices);
    list_photon_passes(plan, slices, add);
    add(true, "shade.resolve", slices);
    add(plan.sums_bias, "photon.bias", slices);
    add(plan.has(Effect::aov), "aov.surface", slices);
    add(plan.has(Effect::aov), "aov.position", slices_of_a_sample(plan));
    const std::size_t not_added = 1 + (plan.sums_squares ? 1 : 0) + (plan.sums_bias ? 1 : 0);
    add(true, "film.add", slices * (film_planes(plan).size() - not_added));
    add(plan.sums_squares, "film.square", slices);
}

void list_buffers(RenderPlan& plan) {
    const auto transient = [&](bool on, const std::string& name, std::uint64_t bytes) {
        if (on) plan.buffers.push_back({name, bytes, false});
    };
    const auto persistent = [&](bool on, const std::string& name, std::uint64_t bytes) {
        if (on) plan.buffers.push_back({name, bytes, true});
    };
    const auto by_address = [&](bool on, const std::string& name, std::uint64_t bytes, bool is_persistent) {
        if (on) plan.buffers.push_back({name, bytes, is_persistent, true});
    };
    const bool traced = plan.has(Effect::voxels) || plan.has(Effect::spheres);
    const std::uint64_t pixels = plan.slice_pixels();
    transient(true, "frame", sizeof(gpu::FrameParams));
    transient(true, "tally", gpu::kTallyCount * sizeof(gpu::uint));
    by_address(plan.has(Effect::voxels), "world.roots", plan.world.root_bytes, true);
    by_address(plan.has(Effect::voxels), "world.nodes", plan.world.node_bytes, true);
    by_address(plan.has(Effect::voxels), "world.leaves", plan.world.leaf_bytes, true);
    const bool grows = plan.has(Effect::voxels) && plan.world.growth.steps > 0;
    transient(grows, "world.homes", plan.world.growth.home_bytes);
    by_address(grows, "world.grown", plan.world.growth.grown_bytes, false);
    persistent(plan.has(Effect::spheres), "sphere.records",
               std::max(plan.sphere_count, gpu::kFewSpheres) * sizeof(gpu::SphereRecord));
    persistent(traced, "materials", plan.material_count * sizeof(gpu::SurfaceMaterial));
    transient(plan.has(Effect::voxels), "primary.starts", plan.slice_tiles() * sizeof(float));
    transient(plan.has(Effect::voxels), "primary.hits", pixels * sizeof(gpu::Hit));
    transient(plan.has(Effect::spheres), "sphere.hits", pixels * sizeof(gpu::Hit));
    transient(plan.has(Effect::specular), "specular.hits", pixels * sizeof(gpu::Hit));
    transient(plan.has(Effect::specular), "specular.weights", pixels * sizeof(gpu::vec3));
    const bool lamps = plan.has(Effect::direct) || plan.photons.lamp_photons != 0;
    persistent(lamps, "light.records", plan.world.lights.count * sizeof(gpu::LightRecord));
    persistent(lamps, "light.table", plan.world.lights.count * sizeof(gpu::AliasEntry));
    transient(plan.has(Effect::direct), "direct.light", pixels * sizeof(gpu::vec3));
    list_photon_buffers(plan);
    list_ao_buffers(plan);
    transient(plan.has(Effect::sun), "sun.lit", pixels * sizeof(float));
    transient(true, "shade.color", pixels * sizeof(gpu::vec3));
    transient(plan.has(Effect::aov), "aov.albedo", pixels * sizeof(gpu::vec3));
    transient(plan.has(Effect::aov), "aov.normal", pixels * sizeof(gpu::vec3));
    for (std::uint32_t band = 0; band < plan.band_count; ++band) {
        for (const FilmPlane& plane : film_planes(plan))
            persistent(true, film_buffer(plane.name, band), plan.band_pixels() * plane.components * 8);
        persistent(plan.has(Effect::aov), film_buffer("position", band),
                   plan.band_pixels() * sizeof(gpu::vec3));
        persistent(plan.has(Effect::aov), film_buffer("depth", band), plan.band_pixels() * sizeof(float));
    }
}

}  // namespace voxilux
