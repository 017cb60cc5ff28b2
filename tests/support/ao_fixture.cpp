#include "support/ao_fixture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frame/frame.h"
#include "passes/upload.h"
#include "plan/film_planes.h"
#include "shared/cell_age.h"
#include "shared/sampling.h"
#include "support/test_scenes.h"
#include "world/world_view.h"

#include "shared/camera.h"  // takes the march from world_view.h

namespace voxilux::test {
namespace {

Scene with_hash(Scene scene) {
    scene.settings.ao.method = AoMethod::hash;
    return scene;
}

// The last buffer that holds the frame's visibility.
std::string visibility_buffer(const RenderPlan& plan) {
    return plan.settings.ao.filter % 2 == 1 ? "ao.filtered" : "ao.visibility";
}

}  // namespace

std::optional<std::uint32_t> AoFrame::slot_of(std::size_t pixel) const {
    if (slots[pixel] == gpu::kNoSlot) return std::nullopt;
    return slots[pixel] & ~gpu::kSlotRests;
}

CellSums sums_of(const AoFrame& frame) {
    CellSums sums;
    for (std::size_t slot = 0; slot < frame.keys.size(); ++slot) {
        if (frame.keys[slot] == 0) continue;
        const bool is_new =
            sums.emplace(frame.keys[slot], std::pair(frame.samples[slot], frame.opens[slot])).second;
        EXPECT_TRUE(is_new) << "two slots of one key";
    }
    return sums;
}

AoFixture::AoFixture(Scene scene, Executor& executor)
    : executor_(executor),
      scene_(with_hash(std::move(scene))),
      prepared_(prepare_scene(scene_, {.effects = {.wants_aov = true}}, test_device().limits())) {
    Recording recording;
    record_scene_upload(prepared_.plan, scene_, prepared_.march_world, prepared_.lights, recording);
    record_film_clear(prepared_.plan, recording);
    executor_.run(recording);
}

AoFrame AoFixture::render(const Camera& camera, std::uint32_t sample) {
    Scene seen;
    seen.camera = camera;
    seen.sun = scene_.sun;
    seen.sky = scene_.sky;
    AoFrame frame;
    frame.params = frame_params(prepared_.plan, seen, prepared_.march_world);
    Recording recording;
    const auto rows = static_cast<std::uint32_t>(prepared_.plan.settings.size.y);
    record_frame(prepared_.plan, {.row_count = rows}, frame.params, {sample, state}, recording);
    const std::string hits = prepared_.plan.has(Effect::spheres) ? "sphere.hits" : "primary.hits";
    const bool is_even = state.samples_done % 2 == 0 || !prepared_.plan.ao.reprojects;
    const std::string slots = is_even ? "ao.slots_even" : "ao.slots_odd";
    const std::string visibility = visibility_buffer(prepared_.plan);
    for (const std::string& buffer :
         {hits, slots, visibility, std::string("ao.keys"), std::string("ao.samples"),
          std::string("ao.unoccluded"), std::string("counters")})
        recording.readback(buffer);
    const RunResult result = executor_.run(recording);
    frame.hits = values_of<gpu::Hit>(result, hits);
    frame.slots = values_of<gpu::uint>(result, slots);
    frame.visibility = values_of<float>(result, visibility);
    frame.keys = values_of<std::uint64_t>(result, "ao.keys");
    frame.samples = values_of<std::uint64_t>(result, "ao.samples");
    frame.opens = values_of<std::uint64_t>(result, "ao.unoccluded");
    const auto counters = values_of<gpu::uint>(result, "counters");
    std::copy_n(counters.begin(), frame.counters.size(), frame.counters.begin());
    for (std::size_t i = 0; i < gpu::kFaultCount; ++i)
        EXPECT_TRUE(frame.counters[i] == 0 || i == gpu::kFaultAoTableFull)
            << "fault " << gpu::kCounterNames[i];
    state.finish_sample(frame.params);
    state.live_cells +=
        std::uint64_t{frame.counters[gpu::kWorkAoClaimed]} - frame.counters[gpu::kWorkAoEvicted];
    ++state.frames_done;
    return frame;
}

void AoFixture::set_sums(const std::vector<std::uint64_t>& samples, const std::vector<std::uint64_t>& opens) {
    Recording recording;
    const std::uint64_t slots = prepared_.plan.ao.slots;
    recording.upload(declare<std::uint64_t>(recording, "ao.samples", slots, Lifetime::persistent),
                     std::as_bytes(std::span(samples)));
    recording.upload(declare<std::uint64_t>(recording, "ao.unoccluded", slots, Lifetime::persistent),
                     std::as_bytes(std::span(opens)));
    executor_.run(recording);
}

Scene pillared_scene() {
    Scene scene = white_scene();
    add_box(scene, {-24, -24, -1}, {24, 24, 0});
    for (const glm::ivec3 foot : {glm::ivec3(-9, -7, 0), glm::ivec3(4, -10, 0), glm::ivec3(7, 6, 0)})
        add_box(scene, foot, foot + glm::ivec3(2, 3, 7));
    add_box(scene, {-10, 5, 0}, {-1, 6, 5});
    add_box(scene, {-10, 7, 0}, {-1, 8, 5});
    scene.camera = flying_camera(0);
    scene.settings.size = {64, 36};
    scene.settings.ao_rays = 2;
    scene.settings.ao_radius = 8.0f;
    scene.settings.ao.cell_px = 1.5f;  // cells of several levels, and many for so few pixels
    scene.settings.ao.slots = 1u << 14;
    return scene;
}

Camera flying_camera(int frame) {
    const double angle = 0.021 * frame;
    const glm::dvec3 position(26.0 * std::cos(angle), 22.0 * std::sin(angle),
                              13.0 + 6.0 * std::sin(3.0 * angle));
    return camera_towards(position, {0.0, 0.0, 1.0}, 50.0);
}

std::string key_disagreement(const AoFixture& fixture, const AoFrame& frame, const gpu::Hit& hit,
                             std::uint64_t key) {
    constexpr double kWidthError = 1e-6;  // relative: some roundings of floats
    const double pixel = 2.0 * glm::length(glm::dvec3(frame.params.camera_up)) / frame.params.height;
    const double width = double{hit.t} * double{fixture.plan().settings.ao.cell_px} * pixel;
    for (const double error : {-kWidthError, kWidthError}) {
        const std::uint32_t level = level_of(width * (1.0 + error));
        if (key_of(cell_around(hit.cell, hit.face, glm::dvec3(hit.fraction), level)) == key) return "";
    }
    const auto cell = cell_of_key(key);
    return fmt::format("hit of voxel ({}, {}, {}), face {}, width {} has key {:016x} of level {}", hit.cell.x,
                       hit.cell.y, hit.cell.z, hit.face, width, key,
                       cell ? static_cast<int>(cell->level) : -1);
}

std::uint64_t open_samples(const AoFixture& fixture, std::uint64_t key, std::uint64_t first,
                           std::uint64_t end) {
    const gpu::AoCell cell = cell_of_key(key).value();
    const gpu::uint stream = gpu::ao_cell_stream(key_words(key));
    const RenderSettings& settings = fixture.scene().settings;
    constexpr gpu::uint kSequences[] = {gpu::kSequenceSobol, gpu::kSequenceHalton, gpu::kSequenceWhite};
    const gpu::uint sequence = kSequences[static_cast<std::size_t>(settings.sequence)];
    std::uint64_t open = 0;
    for (std::uint64_t n = first; n < end; ++n) {
        const gpu::SampleKey sample = gpu::sample_key(stream, key_words(n), settings.seed);
        const gpu::vec3 direction =
            gpu::cosine_on_face(cell.face, gpu::sample_2d(sequence, sample, gpu::kPairOcclusion));
        const gpu::vec3 start = gpu::ao_cell_point(cell, gpu::sample_2d(sequence, sample, gpu::kPairPixel));
        const gpu::Ray ray = gpu::spawn_ray(cell.voxel, cell.face, start, direction, settings.ao_radius);
        const gpu::MarchHit hit = gpu::march(fixture.march_world(), ray, fixture.march_world().chunks_size);
        open += hit.face == gpu::kFaceMiss ? 1 : 0;
    }
    return open;
}

}  // namespace voxilux::test
