#pragma once

// A scene on the device, and one variant of occlusion rendered over a motion of its camera.

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

// The scene of procedural_scene with its camera among the boxes, a little above the highest ground.
[[nodiscard]] Scene ao_procedural_scene(int extent, std::uint32_t seed, glm::ivec2 size);

// The scene of a file with its camera and `size` as that of its picture. Throws Error(input_refused) as
// load_scene, and when there is no voxel.
[[nodiscard]] Scene ao_file_scene(const std::filesystem::path& file, glm::ivec2 size);

// What to render of a variant.
struct AoTake {
    const AoVariant& variant;
    Motion motion = Motion::still;
    int frames = 1;
    std::uint32_t rays = 1;  // per pixel and frame
    std::set<int> kept;      // frames whose visibility is wanted, from 1
};

// What the frames of a take gave.
struct AoFootage {
    std::map<int, std::vector<float>> visibility;  // [height][width] of the kept frames
    AoWork first;                                  // of frame 1, which finds the table empty
    AoWork rest;                                   // of all others
    std::vector<std::vector<AoPassTime>> passes;   // of each frame, those of occlusion
    std::vector<Seconds> seconds;                  // of each frame
    std::uint32_t slots = 0;                       // of the table
};

class AoStage {
  public:
    // Puts the scene on the device. Throws as prepare_scene.
    AoStage(Scene scene, Device& device);

    // Renders the frames of a take from an empty table on, each with the same points of the pixels.
    [[nodiscard]] AoFootage play(const AoTake& take);

    // Visibility by `rays` rays per pixel of the Sobol sequence, at a frame of a motion, for the pixels of
    // every fourth strip of rows that show voxels. `sequence` is that of the variants it is for: it decides
    // where in a pixel they look.
    [[nodiscard]] AoReference reference(Motion motion, int frame, Sequence sequence, std::uint32_t rays);

  private:
    [[nodiscard]] RenderPlan plan_of(const AoVariant& variant, std::uint32_t rays, int frames);
    [[nodiscard]] gpu::FrameParams params_at(const RenderPlan& plan, Motion motion, int frame);

    const DeviceLimits limits_;
    Scene scene_;
    PreparedScene prepared_;
    Scene seen_;  // the scene's lights and a camera that moves
    Executor executor_;
};

}  // namespace voxilux
