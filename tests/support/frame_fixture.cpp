#include "support/frame_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "frame/frame.h"
#include "passes/upload.h"
#include "plan/film_planes.h"

namespace voxilux::test {
namespace {

// Empty where the plan has no such buffer.
template <class T>
std::vector<T> plane_of(const RunResult& result, const std::string& buffer) {
    return result.readbacks.contains(buffer) ? values_of<T>(result, buffer) : std::vector<T>{};
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
    EXPECT_EQ(prepared_.plan.film_tile_count, 1u) << "a rig renders pictures of one band";
    Recording recording;
    record_scene_upload(prepared_.plan, scene, prepared_.march_world, prepared_.lights, recording);
    record_film_clear(prepared_.plan, recording);
    executor_.run(recording);
}

FramePlanes FrameFixture::render(std::uint32_t sample) {
    Recording recording;
    record_frame(prepared_.plan, tile_of(prepared_.plan, 0, prepared_.plan.film_tile_rows), params_,
                 {sample, state_}, recording);
    const std::string hits = prepared_.plan.has(Effect::spheres) ? "sphere.hits" : "primary.hits";
    for (const std::string& buffer :
         {hits, std::string("ao.visibility"), std::string("sky.light"), std::string("sun.lit"),
          std::string("shade.color"), std::string("counters")}) {
        if (recording.find(buffer) != nullptr) recording.readback(buffer);
    }
    const RunResult result = executor_.run(recording);
    FramePlanes planes{.hits = plane_of<gpu::Hit>(result, hits),
                       .ao = plane_of<float>(result, "ao.visibility"),
                       .sky = plane_of<glm::vec3>(result, "sky.light"),
                       .sun = plane_of<float>(result, "sun.lit"),
                       .color = plane_of<glm::vec3>(result, "shade.color")};
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

std::vector<std::int64_t> FrameFixture::film_sums(const std::string& plane) {
    Recording recording;
    const std::vector<FilmPlane> planes = film_planes(prepared_.plan);
    const auto found = std::ranges::find(planes, plane, &FilmPlane::name);
    VX_ASSERT(found != planes.end());
    const std::string buffer = film_plane<std::int64_t>(prepared_.plan, *found, 0, recording);
    recording.readback(buffer);
    return values_of<std::int64_t>(executor_.run(recording), buffer);
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
