#pragma once

// Runs frames of the occlusion hash on the test device and reads back all their results.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frame/frame_state.h"
#include "jobs/render_session.h"
#include "shared/counters.h"
#include "support/ao_keys.h"
#include "support/device_fixture.h"

namespace voxilux::test {

// What a frame wrote: planes [height][width], and arrays of the table by slot.
struct AoFrame {
    gpu::FrameParams params{};
    std::vector<gpu::Hit> hits;
    std::vector<gpu::uint> slots;
    std::vector<float> visibility;
    std::vector<std::uint64_t> keys;
    std::vector<std::uint64_t> samples;
    std::vector<std::uint64_t> opens;
    std::array<gpu::uint, gpu::kCounterCount> counters{};

    // The slot of a pixel; none when it has no cell.
    [[nodiscard]] std::optional<std::uint32_t> slot_of(std::size_t pixel) const;
};

// Samples and unoccluded samples of the live cells, by key.
using CellSums = std::map<std::uint64_t, std::pair<std::uint64_t, std::uint64_t>>;
[[nodiscard]] CellSums sums_of(const AoFrame& frame);

// A scene on a device, frame by frame, with one sample each. Persistent buffers go by name, so only one
// fixture at a time uses an executor. The test fails when a frame counts a fault other than a full table.
class AoFixture {
  public:
    // Uses the hash whatever method the scene asks for.
    explicit AoFixture(Scene scene, Executor& executor = test_executor());

    // The next frame through a camera; `sample` numbers the points of the pixels and of brute force.
    AoFrame render(const Camera& camera, std::uint32_t sample = 0);
    // The next frame through the scene's own camera.
    AoFrame render(std::uint32_t sample = 0) { return render(*scene_.camera, sample); }

    // Puts other sums into the table before the next frame. Not before the first frame, which empties the
    // table.
    void set_sums(const std::vector<std::uint64_t>& samples, const std::vector<std::uint64_t>& opens);

    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const RenderPlan& plan() const { return prepared_.plan; }
    [[nodiscard]] const MarchWorld& march_world() const { return prepared_.march_world; }

    FrameState state;

  private:
    Executor& executor_;
    Scene scene_;
    PreparedScene prepared_;
};

// A floor with pillars, a slit and a wall: many different visibilities.
[[nodiscard]] Scene pillared_scene();

// A camera that flies around the scene above, a step each frame.
[[nodiscard]] Camera flying_camera(int frame);

// Empty when a hit on a voxel's face has this key because its cell is the one that double precision finds. If
// the cell width is within rounding of a border between levels, either level is right.
[[nodiscard]] std::string key_disagreement(const AoFixture& fixture, const AoFrame& frame,
                                           const gpu::Hit& hit, std::uint64_t key);

// The number of a cell's samples, of those numbered first <= n < end, that meet nothing when marched in C++.
[[nodiscard]] std::uint64_t open_samples(const AoFixture& fixture, std::uint64_t key, std::uint64_t first,
                                         std::uint64_t end);

}  // namespace voxilux::test
