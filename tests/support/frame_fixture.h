#pragma once

// Runs record_frame() on the test device and keeps the output of every pass.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame_state.h"
#include "jobs/render_session.h"
#include "plan/render_plan.h"
#include "shared/counters.h"
#include "shared/gpu_types.h"
#include "support/device_fixture.h"

namespace voxilux::test {

// What the passes of one sample wrote, [height][width]; empty where the plan has no such pass.
struct FramePlanes {
    std::vector<gpu::Hit> hits;
    std::vector<float> ao;
    std::vector<glm::vec3> sky;  // of an atmosphere
    std::vector<float> sun;
    std::vector<glm::vec3> color;
    std::array<gpu::uint, gpu::kCounterCount> counters{};
};

// A scene on a device, sample by sample. Persistent buffers go by name, so only one fixture at a time uses an
// executor. The plan has one film tile and every AOV.
class FrameFixture {
  public:
    // The plan chooses the structure of the world when `traversal` is none.
    explicit FrameFixture(const Scene& scene, Executor& executor = test_executor(),
                          std::optional<Traversal> traversal = std::nullopt);
    FrameFixture(const Scene& scene, const PlanRequest& request, Executor& executor = test_executor());

    // Renders the sample in one piece into the film.
    FramePlanes render(std::uint32_t sample);

    // Renders the sample in tiles of `rows` rows into the film.
    void render_tile(std::uint32_t sample, std::uint32_t rows);

    // Adds a sample of these radiances, one per pixel, to the film, and returns the counters.
    std::array<gpu::uint, gpu::kCounterCount> add_radiance(std::uint32_t sample,
                                                           const std::vector<glm::vec3>& radiance);

    // The exact sums of a film plane, interleaved components.
    [[nodiscard]] std::vector<std::int64_t> film_sums(const std::string& plane);
    void set_film_sums(const std::string& plane, const std::vector<std::int64_t>& sums);

    [[nodiscard]] const RenderPlan& plan() const { return prepared_.plan; }
    [[nodiscard]] const MarchWorld& march_world() const { return prepared_.march_world; }
    [[nodiscard]] const gpu::FrameParams& params() const { return params_; }

  private:
    [[nodiscard]] std::string film_buffer_of(const std::string& plane, Recording& recording) const;

    Executor& executor_;
    PreparedScene prepared_;
    gpu::FrameParams params_;
    FrameState state_;
};

// The first sample of a scene on test_executor(). Fails the test when a fault was counted.
[[nodiscard]] FramePlanes render_first_sample(const Scene& scene);

// render_scene() under validation. Fails the test on any validation message, even at the end of the device,
// and on any fault.
[[nodiscard]] RenderOutcome render_validated(const Scene& scene, RenderOptions options = {});

}  // namespace voxilux::test
