#include "support/frame_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "frame/frame.h"
#include "passes/film/film_add.h"
#include "passes/upload.h"
#include "plan/film_planes.h"

namespace voxilux::test {
namespace {

// One value for each pixel; empty where the plan has no such buffer.
template <class T>
std::vector<T> plane_of(const RunResult& result, const std::string& buffer, std::uint64_t pixels) {
    if (!result.readbacks.contains(buffer)) return {};
    auto values = values_of<T>(result, buffer);
    values.resize(pixels);
    return values;
}

DispatchTile tile_of(const RenderPlan& plan, std::uint32_t first_row, std::uint32_t rows) {
    const auto height = static_cast<std::uint32_t>(plan.settings.size.y);
    return {.first_row = first_row, .row_count = std::min(rows, height - first_row)};
}

}  // namespace

FrameFixture::FrameFixture(const Scene& scene, Executor& executor, std::optional<Traversal> traversal)
    : FrameFixture(scene, PlanRequest{.effects = {.wants_aov = true}, .traversal = traversal}, executor) {}

FrameFixture::FrameFixture(const Scene& scene, const PlanRequest& request, Executor& executor)
    : executor_(executor),
      prepared_(prepare_scene(scene, request, test_device().limits())),
      params_(frame_params(prepared_.plan, scene, prepared_.march_world)) {
    EXPECT_EQ(prepared_.plan.film_tile_count, 1u) << "a fixture renders pictures of one film tile";
    Recording recording;
    record_scene_upload(prepared_.plan, scene, prepared_.march_world, prepared_.lights, recording);
    record_film_clear(prepared_.plan, recording);
    executor_.run(recording);
}

FramePlanes FrameFixture::render(std::uint32_t sample) {
    Recording recording;
    record_frame(prepared_.plan, tile_of(prepared_.plan, 0, prepared_.plan.film_tile_rows), params_,
                 {.sample = sample, .state = state_, .keeps_color = true}, recording);
    const std::string hits = prepared_.plan.has(Effect::spheres) ? "sphere.hits" : "primary.hits";
    for (const std::string& buffer :
         {hits, std::string("ao.visibility"), std::string("sky.light"), std::string("sun.lit"),
          std::string("film.color"), std::string("counters")}) {
        if (recording.find(buffer) != nullptr) recording.readback(buffer);
    }
    const RunResult result = executor_.run(recording);
    const std::uint64_t pixels = prepared_.plan.tile_pixels();
    FramePlanes planes{.hits = plane_of<gpu::Hit>(result, hits, pixels),
                       .ao = plane_of<float>(result, "ao.visibility", pixels),
                       .sky = plane_of<glm::vec3>(result, "sky.light", pixels),
                       .sun = plane_of<float>(result, "sun.lit", pixels),
                       .color = plane_of<glm::vec3>(result, "film.color", pixels)};
    const std::vector<gpu::uint> counters = values_of<gpu::uint>(result, "counters");
    std::copy_n(counters.begin(), planes.counters.size(), planes.counters.begin());
    return planes;
}

void FrameFixture::render_tile(std::uint32_t sample, std::uint32_t rows) {
    const auto height = static_cast<std::uint32_t>(prepared_.plan.settings.size.y);
    for (std::uint32_t row = 0; row < height; row += rows) {
        Recording recording;
        record_frame(prepared_.plan, tile_of(prepared_.plan, row, rows), params_, {sample, state_},
                     recording);
        executor_.run(recording);
    }
}

// A sky of radiance 1, seen through the factors that multiply it: the only term that is exact for any value.
std::array<gpu::uint, gpu::kCounterCount> FrameFixture::add_radiance(std::uint32_t sample,
                                                                     const std::vector<glm::vec3>& radiance) {
    const RenderPlan& plan = prepared_.plan;
    Recording recording;
    gpu::FrameParams params = params_;
    params.sky_radiance = gpu::vec3(1.0f);
    record_frame_upload(params, recording);
    const Plane weights{declare_plane<gpu::vec3>(plan, "test.radiance", recording)};
    recording.upload(weights.buffer, std::as_bytes(std::span(radiance)));
    const Plane miss = constant_miss(recording), none = constant_value(0.0f, recording);
    const FilmInputs inputs{.first_hits = miss,
                            .seen = {miss, weights},
                            .ao = none,
                            .sky = none,
                            .air = none,
                            .sun = none,
                            .direct = none,
                            .photons = {none, none}};
    record_film_add(plan, tile_of(plan, 0, plan.film_tile_rows), inputs, sample, false, recording);
    recording.readback("counters");
    const auto counted = values_of<gpu::uint>(executor_.run(recording), "counters");
    std::array<gpu::uint, gpu::kCounterCount> counters{};
    std::copy_n(counted.begin(), counters.size(), counters.begin());
    return counters;
}

std::string FrameFixture::film_buffer_of(const std::string& plane, Recording& recording) const {
    const std::vector<FilmPlane> planes = film_planes(prepared_.plan);
    const auto found = std::ranges::find(planes, plane, &FilmPlane::name);
    VX_ASSERT(found != planes.end());
    return film_plane<std::int64_t>(prepared_.plan, *found, 0, recording);
}

std::vector<std::int64_t> FrameFixture::film_sums(const std::string& plane) {
    Recording recording;
    const std::string buffer = film_buffer_of(plane, recording);
    recording.readback(buffer);
    auto sums = values_of<std::int64_t>(executor_.run(recording), buffer);
    const std::uint64_t pixels = prepared_.plan.film_tile_pixels();
    sums.resize(sums.size() / plane_elements(pixels) * pixels);  // the last group may be longer
    return sums;
}

void FrameFixture::set_film_sums(const std::string& plane, const std::vector<std::int64_t>& sums) {
    Recording recording;
    recording.upload(film_buffer_of(plane, recording), std::as_bytes(std::span(sums)));
    executor_.run(recording);
}

FramePlanes render_first_sample(const Scene& scene) {
    FramePlanes planes = FrameFixture(scene).render(0);
    for (std::size_t i = 0; i < gpu::kFaultCount; ++i)
        EXPECT_EQ(planes.counters[i], 0u) << "fault " << gpu::kCounterNames[i];
    return planes;
}

RenderOutcome render_validated(const Scene& scene, RenderOptions options) {
    std::vector<std::string> messages;
    options.device.validation = true;
    options.device.on_message = [&](std::string_view text) { messages.emplace_back(text); };
    options.executor.poison_transients = true;
    RenderOutcome outcome = render_scene(scene, options);
    for (const std::string& text : messages)
        ADD_FAILURE() << "validation message: " << text;
    for (const auto& [name, count] : outcome.statistics.faults)
        EXPECT_EQ(count, 0u) << "fault " << name;
    return outcome;
}

}  // namespace voxilux::test
