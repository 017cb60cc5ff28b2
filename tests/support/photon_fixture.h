#pragma once

// Runs the passes that turn stored photons into light on the test device, with photons and visible points
// that a test makes.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "passes/photons/photon.h"
#include "probe/photon_functions.h"
#include "shared/counters.h"
#include "support/device_fixture.h"

namespace voxilux::test {

// A job for the passes: points are the hits of a picture of 'width' columns.
struct PhotonJob {
    std::vector<gpu::PhotonIn> photons;
    std::vector<gpu::Hit> points;
    std::uint32_t width = 16;
    std::vector<gpu::SphereRecord> spheres;
    PhotonSetup setup;
    PhotonRadii radii = PhotonRadii::common;
    std::uint32_t slots_at_once = 1;  // as PhotonPlan::slots_at_once
    bool knows_lanes = true;          // the size of subgroups, as plans for software devices do
};

// What the passes wrote.
struct PhotonOutcome {
    std::vector<glm::vec3> light;
    std::vector<glm::vec3> half_area;
    std::vector<gpu::SortedPhoton> sorted;
    std::vector<gpu::PixelRadius> radii;
    gpu::PhotonHead head{};
    std::array<gpu::uint, gpu::kCounterCount> counters{};
    std::vector<PassTime> times;
};

// The rows of the picture of a job.
[[nodiscard]] std::uint32_t rows_of(const PhotonJob& job);

// A plan with what the passes of a job need and nothing else.
[[nodiscard]] RenderPlan photon_plan(const PhotonJob& job);

// Appends, sorts and gathers, or appends and splats.
[[nodiscard]] PhotonOutcome run_photons(const PhotonJob& job, Executor& executor = test_executor());
[[nodiscard]] PhotonOutcome run_splat(const PhotonJob& job, Executor& executor = test_executor());

}  // namespace voxilux::test
