#pragma once

// A scene on the device, and one variant of occlusion rendered while the camera moves.

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "jobs/bench/ao_motion.h"
#include "jobs/bench/ao_numbers.h"
#include "jobs/bench/ao_row.h"
#include "jobs/bench/ao_variant.h"
#include "jobs/render_session.h"
#include "shared/gpu_types.h"

namespace voxilux {

// The scene of procedural_scene with its camera among the boxes, slightly above the highest ground.
[[nodiscard]] Scene ao_procedural_scene(int extent, std::uint32_t seed, glm::ivec2 size);

// The scene of a file with its camera and an image of `size`. Throws Error(input_refused) as load_scene, and
// when there is no voxel.
[[nodiscard]] Scene ao_file_scene(const std::filesystem::path& file, glm::ivec2 size);

// What to render with a variant.
struct AoTake {
    const AoVariant& variant;
    Motion motion = Motion::still;
    int frames = 1;
    std::uint32_t rays = 1;  // per pixel and frame
    std::set<int> kept;      // frames whose visibility is kept, from 1
};

// What the frames of a take yield.
struct AoFootage {
    std::map<int, std::vector<float>> visibility;  // [height][width], of the kept frames
    AoWork first;                                  // of frame 1, which starts with an empty table
    AoWork rest;                                   // of all others
    std::vector<std::vector<AoPassTime>> passes;   // of each frame, occlusion passes only
    std::vector<Seconds> seconds;                  // of each frame
    std::uint32_t slots = 0;                       // of the table
};

class AoStage {
  public:
    // Puts the scene on the device. Throws as prepare_scene.
    AoStage(Scene scene, Device& device);

    // Renders the frames of a take, starting with an empty table. Each frame has the same sample points in
    // its pixels.
    [[nodiscard]] AoFootage play(const AoTake& take);

    // Visibility from `rays` rays per pixel of the Sobol sequence, at a frame of a motion, for the pixels
    // that show voxels in every fourth strip of rows. `sequence` is that of the variants it is compared with:
    // it decides where in a pixel the camera rays go.
    [[nodiscard]] AoReference reference(Motion motion, int frame, Sequence sequence, std::uint32_t rays);

  private:
    [[nodiscard]] RenderPlan plan_of(const AoVariant& variant, std::uint32_t rays, int frames);
    [[nodiscard]] gpu::FrameParams params_at(const RenderPlan& plan, Motion motion, int frame);

    const DeviceLimits limits_;
    Scene scene_;
    PreparedScene prepared_;
    Scene seen_;  // the scene's lights, and the moving camera
    Executor executor_;
};

}  // namespace voxilux
