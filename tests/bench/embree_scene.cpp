#include "bench/embree_scene.h"

#include <fmt/format.h>
#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "shared/limits.h"

namespace voxilux {
namespace {

// Rays do not count hits nearer than this, in voxels, because a ray that leaves a face would meet that face
// again.
constexpr float kNearest = 1.0e-3f;

// Denormals count as zero while this lives, as Embree's manual asks. The march needs them.
class FlushDenormals {
  public:
    FlushDenormals() { _mm_setcsr(before_ | kFlushToZero | kDenormalsAreZero); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;
    ~FlushDenormals() { _mm_setcsr(before_); }

  private:
    static constexpr unsigned kFlushToZero = 0x8000;
    static constexpr unsigned kDenormalsAreZero = 0x0040;
    unsigned before_ = _mm_getcsr();
};

template <int N>
void put_ray(RTCRayNt<N>& packet, std::size_t lane, const gpu::Ray& ray) {
    packet.org_x[lane] = static_cast<float>(ray.cell.x) + ray.fraction.x;
    packet.org_y[lane] = static_cast<float>(ray.cell.y) + ray.fraction.y;
    packet.org_z[lane] = static_cast<float>(ray.cell.z) + ray.fraction.z;
    packet.tnear[lane] = kNearest;
    packet.dir_x[lane] = ray.direction.x;
    packet.dir_y[lane] = ray.direction.y;
    packet.dir_z[lane] = ray.direction.z;
    packet.tfar[lane] = ray.t_max < gpu::kUnbounded ? ray.t_max : std::numeric_limits<float>::infinity();
    packet.mask[lane] = 0xFFFFFFFFu;
}

template <int N>
std::vector<RTCRayNt<N>> to_packets(std::span<const gpu::Ray> rays) {
    std::vector<RTCRayNt<N>> packets((rays.size() + N - 1) / N);
    for (std::size_t i = 0; i < rays.size(); ++i)
        put_ray(packets[i / N], i % N, rays[i]);
    return packets;
}

// Which lanes of a packet hold one of the last `left` rays: -1, else 0.
template <int N>
std::array<int, N> lanes_of(std::size_t left) {
    std::array<int, N> valid;
    for (std::size_t lane = 0; lane < N; ++lane)
        valid[lane] = lane < left ? -1 : 0;
    return valid;
}

// The packets of N rays have the layout of Embree's types for N = 1, 8 and 16, which are aligned to 16, 32
// and 64 bytes.
template <int N>
void call_intersect(const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRayHitNt<N>& packet) {
    if constexpr (N == 1)
        rtcIntersect1(scene, &context, reinterpret_cast<RTCRayHit*>(&packet));
    else if constexpr (N == 8)
        rtcIntersect8(valid, scene, &context, reinterpret_cast<RTCRayHit8*>(&packet));
    else
        rtcIntersect16(valid, scene, &context, reinterpret_cast<RTCRayHit16*>(&packet));
}

template <int N>
void call_occluded(const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRayNt<N>& packet) {
    if constexpr (N == 1)
        rtcOccluded1(scene, &context, reinterpret_cast<RTCRay*>(&packet));
    else if constexpr (N == 8)
        rtcOccluded8(valid, scene, &context, reinterpret_cast<RTCRay8*>(&packet));
    else
        rtcOccluded16(valid, scene, &context, reinterpret_cast<RTCRay16*>(&packet));
}

void refuse_if_failed(RTCDevice device) {
    const RTCError code = rtcGetDeviceError(device);
    if (code == RTC_ERROR_OUT_OF_MEMORY)
        throw Error(ExitCode::out_of_memory, "Embree is out of memory; choose a smaller --extent");
    if (code != RTC_ERROR_NONE)
        throw Error(ExitCode::internal, fmt::format("Embree failed with error {}", static_cast<int>(code)));
}

void fill_quads(RTCGeometry geometry, std::span<const ExposedFace> faces) {
    constexpr std::size_t kCornerBytes = 3 * sizeof(float);
    auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, kCornerBytes, 4 * faces.size()));
    auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), faces.size()));
    if (vertices == nullptr || indices == nullptr) return;  // the device reports the error
    std::iota(indices, indices + 4 * faces.size(), 0u);
    float* out = vertices;
    for (const ExposedFace& face : faces) {
        for (const glm::vec3& corner : corners_of(face)) {
            for (int a = 0; a < 3; ++a)
                *out++ = corner[a];
        }
    }
}

}  // namespace

std::string EmbreeQuery::name() const {
    return fmt::format("embree.{}{}{}", any_hit ? "occluded" : "intersect", width,
                       coherent ? ".coherent" : "");
}

EmbreeScene::EmbreeScene(const VoxelWorld& world)
    : faces_(exposed_faces(world)), device_(rtcNewDevice("threads=1")) {
    rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
    scene_ = rtcNewScene(device_);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
    fill_quads(geometry, faces_);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    refuse_if_failed(device_);
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

bool EmbreeScene::count_bytes(void* total, ssize_t change, bool) {
    static_cast<std::atomic<std::uint64_t>*>(total)->fetch_add(static_cast<std::uint64_t>(change));
    return true;
}

std::vector<EmbreeQuery> EmbreeScene::queries() const {
    std::vector<EmbreeQuery> all;
    for (const bool any_hit : {false, true}) {
        all.push_back({.any_hit = any_hit});
        for (const auto& [width, property] : {std::pair(8, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED),
                                              std::pair(16, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)}) {
            if (rtcGetDeviceProperty(device_, property) == 0) continue;
            for (const bool coherent : {false, true})
                all.push_back({any_hit, width, coherent});
        }
    }
    return all;
}

EmbreeScene::Answer EmbreeScene::prepare(const EmbreeQuery& query, std::span<const gpu::Ray> rays) const {
    if (query.width == 1) return prepare_packets<1>(query, rays);
    return query.width == 8 ? prepare_packets<8>(query, rays) : prepare_packets<16>(query, rays);
}

template <int N>
EmbreeScene::Answer EmbreeScene::prepare_packets(const EmbreeQuery& query,
                                                 std::span<const gpu::Ray> rays) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (query.coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return [this, context, any_hit = query.any_hit,
            packets = to_packets<N>(rays)](std::span<gpu::BenchHit> hits) {
        const FlushDenormals flush;
        if (any_hit)
            find_occluded<N>(context, packets, hits);
        else
            intersect<N>(context, packets, hits);
    };
}

template <int N>
void EmbreeScene::intersect(RTCIntersectContext context, std::span<const RTCRayNt<N>> packets,
                            std::span<gpu::BenchHit> hits) const {
    alignas(64) RTCRayHitNt<N> found;
    for (std::size_t first = 0; first < hits.size(); first += N) {
        const std::size_t left = hits.size() - first;
        found.ray = packets[first / N];
        std::ranges::fill(found.hit.geomID, RTC_INVALID_GEOMETRY_ID);
        call_intersect<N>(lanes_of<N>(left).data(), scene_, context, found);
        for (std::size_t lane = 0; lane < std::min<std::size_t>(left, N); ++lane) {
            gpu::BenchHit& hit = hits[first + lane];
            hit = {.cell = glm::ivec3(-1), .face = gpu::kFaceMiss};
            if (found.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
            const ExposedFace& face = faces_[found.hit.primID[lane]];
            hit = {.cell = face.cell, .face = face.face, .t = found.ray.tfar[lane]};
        }
    }
}

template <int N>
void EmbreeScene::find_occluded(RTCIntersectContext context, std::span<const RTCRayNt<N>> packets,
                                std::span<gpu::BenchHit> hits) const {
    alignas(64) RTCRayNt<N> rays;
    for (std::size_t first = 0; first < hits.size(); first += N) {
        const std::size_t left = hits.size() - first;
        rays = packets[first / N];
        call_occluded<N>(lanes_of<N>(left).data(), scene_, context, rays);
        for (std::size_t lane = 0; lane < std::min<std::size_t>(left, N); ++lane) {
            const bool is_hit = rays.tfar[lane] < 0.0f;
            hits[first + lane] = {.cell = glm::ivec3(-1), .face = is_hit ? gpu::kFaceInside : gpu::kFaceMiss};
        }
    }
}

}  // namespace voxilux
