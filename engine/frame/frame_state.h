#pragma once

#include <cstdint>
#include <optional>

#include "shared/gpu_types.h"

namespace voxilux {

// What outlives a sample and a frame on the host. On the device only persistent buffers do.
struct FrameState {
    std::uint64_t frames_done = 0;
    std::uint64_t samples_done = 0;               // since the occlusion cells were emptied
    std::optional<gpu::FrameParams> last_camera;  // of the sample before; none after a change of the world

    std::uint64_t live_cells = 0;  // of occlusion

    // To be called after each sample of the whole image.
    void finish_sample(const gpu::FrameParams& params) {
        ++samples_done;
        last_camera = params;
    }
    // The world has changed: what was learned of the old one is void.
    void change_world() {
        samples_done = 0;
        live_cells = 0;
        last_camera.reset();
    }
};

}  // namespace voxilux
