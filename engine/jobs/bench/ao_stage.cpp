#include "jobs/bench/ao_stage.h"

#include <algorithm>

#include "base/error.h"
#include "embedded.h"
#include "formats/scene_toml.h"
#include "frame/footprint.h"
#include "frame/frame.h"
#include "jobs/bench/bench_scene.h"
#include "passes/ao/ao.h"
#include "passes/primary/primary.h"
#include "passes/primary/sphere.h"
#include "passes/upload.h"
#include "renderer/film_steps.h"
#include "scene/scene_camera.h"
#include "shared/sequence.h"

namespace voxilux {
namespace {

// The reference traces kStripRows rows of every kStripPeriod: enough pixels for a mean, in a quarter of the
// time. A strip is as high as a workgroup.
constexpr std::uint32_t kStripRows = 8;
constexpr std::uint32_t kStripPeriod = 32;

constexpr int kMaterials = 24;  // of procedural_scene

// Occlusion and what it needs, without the sun and without output files.
PlanRequest occlusion_request(int frames) {
    PlanRequest request{.frames = static_cast<std::uint32_t>(frames)};
    request.effects.switches = {{Effect::ao, Switch::on}, {Effect::sun, Switch::off}};
    return request;
}

// The buffer that holds the final visibility of a frame.
std::string visibility_buffer(const RenderPlan& plan) {
    return plan.ao.uses_cells() && plan.settings.ao.filter % 2 == 1 ? "ao.filtered" : "ao.visibility";
}

// Pixels of the tile. The buffer has room for the largest tile.
std::uint64_t pixels_of(const RenderPlan& plan, const DispatchTile& tile) {
    return std::uint64_t{tile.row_count} * static_cast<std::uint64_t>(plan.settings.size.x);
}

std::vector<AoPassTime> occlusion_times(const RunResult& result) {
    std::vector<AoPassTime> times;
    for (const PassTime& pass : result.passes)
        if (pass.label.starts_with("ao.")) times.push_back({pass.label, pass.ms});
    return times;
}

// The strip of rows, beginning at `first`, that a reference traces at once.
DispatchTile strip_at(const RenderPlan& plan, std::uint32_t first) {
    const auto height = static_cast<std::uint32_t>(plan.settings.size.y);
    const std::uint32_t film_tile = first / plan.film_tile_rows;
    const std::uint32_t film_tile_first_row = film_tile * plan.film_tile_rows;
    const std::uint32_t end =
        std::min({height, film_tile_first_row + plan.film_tile_rows, first + plan.tile_rows});
    return {film_tile, film_tile_first_row, first, std::min(kStripRows, end - first)};
}

struct TracedStrip {
    std::string hits;
    std::string visibility;
};

// Records the hits of a strip and their visibility by rays of the Sobol sequence.
TracedStrip record_strip(const RenderPlan& plan, const DispatchTile& tile, gpu::FrameParams params,
                         Recording& recording) {
    params.first_row = tile.first_row;
    params.row_count = tile.row_count;
    params.film_tile_first_row = tile.film_tile_first_row;
    record_frame_upload(params, recording);
    Plane hits = record_primary_march(plan, tile, record_primary_beam(plan, tile, recording), recording);
    if (plan.has(Effect::spheres)) hits = record_sphere_trace(plan, tile, hits, recording);
    RenderPlan traced = plan;
    traced.settings.sequence = Sequence::sobol;
    return {hits.buffer, record_ao_trace(traced, tile, hits, recording).buffer};
}

}  // namespace

Scene ao_procedural_scene(int extent, std::uint32_t seed, glm::ivec2 size) {
    const BenchScene bench = procedural_scene(extent, seed);
    Scene scene;
    scene.materials.resize(kMaterials);
    VoxelModel model{.name = bench.name, .size = bench.world.size()};
    bench.world.for_each_voxel([&](glm::ivec3 c, std::uint16_t voxel) {
        model.voxels.push_back({static_cast<std::uint16_t>(c.x), static_cast<std::uint16_t>(c.y),
                                static_cast<std::uint16_t>(c.z), static_cast<std::uint16_t>(voxel & 0x7FFF)});
    });
    scene.instances.push_back({.model = 0, .translation = model.size / 2});
    scene.models.push_back(std::move(model));
    scene.camera = bench.camera;
    scene.camera->position.z = 0.3 * extent;
    scene.camera->pitch_deg = -12.0;
    scene.settings.size = size;
    return scene;
}

Scene ao_file_scene(const std::filesystem::path& file, glm::ivec2 size) {
    Scene scene = load_scene(file);
    scene.settings.size = size;
    if (!measure_scene(scene).has_voxels)
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: there is no voxel whose occlusion could be found", file.string()));
    return scene;
}

AoStage::AoStage(Scene scene, Device& device)
    : limits_(device.limits()),
      scene_(std::move(scene)),
      prepared_(prepare_scene(scene_, occlusion_request(1), limits_)),
      executor_(device, pass_shaders()) {
    seen_.camera = camera_of(scene_);
    seen_.sky = scene_.sky;
    Recording recording;
    record_scene_upload(prepared_.plan, scene_, prepared_.march_world, prepared_.lights, recording);
    executor_.run(recording);
}

RenderPlan AoStage::plan_of(const AoVariant& variant, std::uint32_t rays, int frames) {
    RenderSettings& settings = scene_.settings;
    settings.ao = variant.ao;
    settings.sequence = variant.sequence;
    settings.ao_rays = rays;
    settings.spp = 1;
    return plan_within_memory(scene_, prepared_.facts, prepared_.plan.world, occlusion_request(frames),
                              limits_);
}

gpu::FrameParams AoStage::params_at(const RenderPlan& plan, Motion motion, int frame) {
    const Camera start = *seen_.camera;
    seen_.camera = moved_camera(start, motion, frame, plan.settings.size.y);
    const gpu::FrameParams params = frame_params(plan, seen_, prepared_.march_world);
    seen_.camera = start;
    return params;
}

AoFootage AoStage::play(const AoTake& take) {
    const RenderPlan plan = plan_of(take.variant, take.rays, take.frames);
    const DispatchTile whole{.row_count = static_cast<std::uint32_t>(plan.settings.size.y)};
    const std::string visibility = visibility_buffer(plan);
    AoFootage footage{.slots = plan.ao.slots};
    FilmSteps steps(plan, executor_, limits_.is_cpu);
    for (int frame = 1; frame <= take.frames; ++frame) {
        steps.start_frame(params_at(plan, take.motion, frame));
        const bool is_kept = take.kept.contains(frame);
        const Stopwatch watch;
        StepResult done;
        const RunResult result = steps.take(whole, done, std::span(&visibility, is_kept ? 1 : 0));
        footage.seconds.push_back(watch.elapsed());
        footage.passes.push_back(occlusion_times(result));
        const auto counted = values_of<gpu::uint>(result, "counters");
        (frame == 1 ? footage.first : footage.rest).add(std::span(counted).first<gpu::kCounterCount>());
        if (is_kept) footage.visibility[frame] = values_of<float>(result, visibility);
    }
    return footage;
}

AoReference AoStage::reference(Motion motion, int frame, Sequence sequence, std::uint32_t rays) {
    const RenderPlan plan = plan_of({"reference", {.method = AoMethod::brute}, sequence}, rays, 1);
    const gpu::FrameParams params = params_at(plan, motion, frame);
    const auto width = static_cast<std::size_t>(plan.settings.size.x);
    AoReference reference;
    for (std::uint32_t row = 0; row < params.height; row += kStripPeriod) {
        const DispatchTile tile = strip_at(plan, row);
        Recording recording;
        const TracedStrip strip = record_strip(plan, tile, params, recording);
        recording.readback(strip.hits, 0, pixels_of(plan, tile) * sizeof(gpu::Hit));
        recording.readback(strip.visibility, 0, pixels_of(plan, tile) * sizeof(float));
        const RunResult result = executor_.run(recording);
        const auto seen = values_of<gpu::Hit>(result, strip.hits);
        const auto visibility = values_of<float>(result, strip.visibility);
        for (std::size_t i = 0; i < seen.size(); ++i) {
            if (seen[i].face >= gpu::kFaceInside) continue;
            reference.pixels.push_back(row * width + i);
            reference.visibility.push_back(visibility[i]);
        }
    }
    return reference;
}

}  // namespace voxilux
