#pragma once

// The world of a benchmark in Embree, and rays through it one by one or in packets.

#include <embree3/rtcore.h>

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/exposed_faces.h"

namespace voxilux {

// One of Embree's calls. Those for whether anything is in the way give kFaceInside or kFaceMiss for a face.
struct EmbreeQuery {
    bool any_hit = false;  // rtcOccluded, else rtcIntersect
    int width = 1;         // rays in a call: 1, 8 or 16
    bool coherent = false;

    [[nodiscard]] std::string name() const;  // "embree.intersect8.coherent"
};

// Exposed faces as quads, built with Embree's defaults. `bytes` is what Embree holds: vertices, indices and
// its tree.
class EmbreeScene {
  public:
    explicit EmbreeScene(const VoxelWorld& world);
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    ~EmbreeScene();

    [[nodiscard]] std::uint64_t bytes() const { return bytes_.load(); }

    // Every query that this machine answers by instructions of that width.
    [[nodiscard]] std::vector<EmbreeQuery> queries() const;

    // What asks the query for all rays, one entry of hits each. The rays are brought into Embree's form here,
    // and not when it runs. It must not outlive this.
    using Answer = std::function<void(std::span<gpu::BenchHit> hits)>;
    [[nodiscard]] Answer prepare(const EmbreeQuery& query, std::span<const gpu::Ray> rays) const;

  private:
    static bool count_bytes(void* total, ssize_t change, bool is_after);

    template <int N>
    [[nodiscard]] Answer prepare_packets(const EmbreeQuery& query, std::span<const gpu::Ray> rays) const;
    template <int N>
    void intersect(RTCIntersectContext context, std::span<const RTCRayNt<N>> packets,
                   std::span<gpu::BenchHit> hits) const;
    template <int N>
    void find_occluded(RTCIntersectContext context, std::span<const RTCRayNt<N>> packets,
                       std::span<gpu::BenchHit> hits) const;

    std::atomic<std::uint64_t> bytes_ = 0;
    std::vector<ExposedFace> faces_;  // by number of the quad
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

}  // namespace voxilux
