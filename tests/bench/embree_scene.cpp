#include "bench/embree_scene.h"

#include <fmt/format.h>

#include <limits>
#include <numeric>

#include "base/error.h"
#include "shared/limits.h"

namespace voxilux {
namespace {

// Rays do not count hits nearer than this, in voxels, because a ray that leaves a face would meet that face
// again.
constexpr float kNearest = 1.0e-3f;

RTCRay to_embree(const gpu::Ray& ray) {
    RTCRay to{};
    to.org_x = static_cast<float>(ray.cell.x) + ray.fraction.x;
    to.org_y = static_cast<float>(ray.cell.y) + ray.fraction.y;
    to.org_z = static_cast<float>(ray.cell.z) + ray.fraction.z;
    to.tnear = kNearest;
    to.dir_x = ray.direction.x;
    to.dir_y = ray.direction.y;
    to.dir_z = ray.direction.z;
    to.tfar = ray.t_max < gpu::kUnbounded ? ray.t_max : std::numeric_limits<float>::infinity();
    to.mask = 0xFFFFFFFFu;
    return to;
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

void EmbreeScene::intersect(std::span<const gpu::Ray> rays, std::span<gpu::BenchHit> hits) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        RTCRayHit found{.ray = to_embree(rays[i]), .hit = {}};
        found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &found);
        gpu::BenchHit& hit = hits[i];
        hit = {.cell = glm::ivec3(-1), .face = gpu::kFaceMiss};
        if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
        const ExposedFace& face = faces_[found.hit.primID];
        hit = {.cell = face.cell, .face = face.face, .t = found.ray.tfar};
    }
}

void EmbreeScene::find_occluded(std::span<const gpu::Ray> rays, std::span<gpu::BenchHit> hits) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        RTCRay ray = to_embree(rays[i]);
        rtcOccluded1(scene_, &context, &ray);
        hits[i] = {.cell = glm::ivec3(-1), .face = ray.tfar < 0.0f ? gpu::kFaceInside : gpu::kFaceMiss};
    }
}

}  // namespace voxilux
