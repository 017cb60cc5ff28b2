#pragma once

#include <cstdint>

#include "frame/frame_state.h"
#include "passes/plane.h"
#include "shared/gpu_types.h"

namespace voxilux {

// The camera and the lights of a frame in the shaders' terms, relative to the world's corner. The fields of
// the dispatch tile and of the sample are set in each recording. Throws Error(input_refused) for a camera
// further than 2^23 voxels from the world, where a float can no longer tell neighbouring voxels apart.
[[nodiscard]] gpu::FrameParams frame_params(const RenderPlan& plan, const Scene& scene,
                                            const MarchWorld& march_world);

// Which sample of which frame a recording renders.
struct SampleNumber {
    std::uint32_t sample = 0;  // of the frame
    FrameState state;          // what earlier frames and samples left behind
    std::uint32_t first = 0;   // the sample that gives the film its positions and depths
    bool keeps_color = false;  // the colours of this sample, in the plane "film.color"
};

// One sample of every pixel of a tile, from camera rays to the film.
void record_frame(const RenderPlan& plan, const DispatchTile& tile, gpu::FrameParams params,
                  const SampleNumber& number, Recording& recording);

}  // namespace voxilux
