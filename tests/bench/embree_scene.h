#pragma once

// The world of a benchmark in Embree, and rays through it one by one.

#include <embree3/rtcore.h>

#include <atomic>
#include <memory>
#include <span>
#include <vector>

#include "bench/exposed_faces.h"

namespace voxilux {

// Exposed faces as quads, built with Embree's defaults. `bytes` is what Embree holds: vertices, indices and
// its tree.
class EmbreeScene {
  public:
    explicit EmbreeScene(const VoxelWorld& world);
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    ~EmbreeScene();

    [[nodiscard]] std::uint64_t bytes() const { return bytes_.load(); }
    [[nodiscard]] std::size_t face_count() const { return faces_.size(); }

    // Closest hits of the rays by rtcIntersect1, one entry each.
    void intersect(std::span<const gpu::Ray> rays, std::span<gpu::BenchHit> hits) const;

    // Whether anything is in the way, by rtcOccluded1: face is kFaceInside if so, else kFaceMiss.
    void find_occluded(std::span<const gpu::Ray> rays, std::span<gpu::BenchHit> hits) const;

  private:
    static bool count_bytes(void* total, ssize_t change, bool is_after);

    std::atomic<std::uint64_t> bytes_ = 0;
    std::vector<ExposedFace> faces_;  // by number of the quad
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

}  // namespace voxilux
