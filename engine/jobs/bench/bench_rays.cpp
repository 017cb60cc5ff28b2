#include "jobs/bench/bench_rays.h"

#include <cmath>
#include <numbers>

#include "jobs/bench/item_named.h"
#include "scene/scene_camera.h"
#include "world/world_view.h"  // needs the world access that this header gives

#include "shared/camera.h"
#include "shared/sampling.h"

namespace voxilux {
namespace {

constexpr float kOcclusionReach = 32.0f;  // voxels
constexpr int kTile = 8;                  // pixels
constexpr std::array<std::string_view, kRayKinds.size()> kRayNames = {"primary", "ao", "long"};

// Calls visit(x, y) for the pixels of the image in the order of bench_rays.
template <class Visit>
void for_each_pixel(glm::ivec2 size, const Visit& visit) {
    const glm::ivec2 tiles = (size + kTile - 1) / kTile;
    const int first_half = (tiles.y + 1) / 2;
    for (int i = 0; i < tiles.y; ++i) {
        const int tile_row = i < first_half ? 2 * i : 2 * (i - first_half) + 1;
        for (int tile_column = 0; tile_column < tiles.x; ++tile_column) {
            for (int lane = 0; lane < kTile * kTile; ++lane) {
                const glm::ivec2 pixel =
                    glm::ivec2(tile_column, tile_row) * kTile + glm::ivec2(lane % kTile, lane / kTile);
                if (pixel.x < size.x && pixel.y < size.y) visit(pixel);
            }
        }
    }
}

}  // namespace

std::string_view name_of(RayKind kind) {
    return kRayNames[static_cast<std::size_t>(kind)];
}

RayKind ray_kind_named(std::string_view name) {
    return item_named("rays", name, kRayKinds, [](RayKind kind) { return name_of(kind); });
}

gpu::FrameParams bench_frame(const BenchScene& scene, glm::ivec2 size, std::uint32_t seed) {
    const glm::dvec3 local = scene.camera.position - glm::dvec3(scene.world.origin());
    const glm::dvec3 cell = glm::floor(local);
    const glm::dmat3 basis = camera_basis(scene.camera);
    const double half_height = std::tan(scene.camera.fov_y_deg * std::numbers::pi / 360.0);
    const double aspect = static_cast<double>(size.x) / static_cast<double>(size.y);
    gpu::FrameParams params{};
    params.chunks = scene.world.chunks();
    params.camera_cell = glm::ivec3(cell);
    params.camera_fraction = glm::vec3(local - cell);
    params.camera_right = glm::vec3(basis[0] * half_height * aspect);
    params.camera_up = glm::vec3(basis[1] * half_height);
    params.camera_forward = glm::vec3(basis[2]);
    params.width = static_cast<gpu::uint>(size.x);
    params.height = static_cast<gpu::uint>(size.y);
    params.row_count = params.height;
    params.column_count = params.width;
    params.seed = seed;
    return params;
}

std::vector<gpu::Ray> bench_rays(const BenchScene& scene, const MarchWorld& guide, RayKind kind,
                                 glm::ivec2 size, std::uint32_t seed) {
    const gpu::FrameParams params = bench_frame(scene, size, seed);
    std::vector<gpu::Ray> rays;
    for_each_pixel(size, [&](glm::ivec2 pixel) {
        const auto x = static_cast<gpu::uint>(pixel.x);
        const auto y = static_cast<gpu::uint>(pixel.y);
        const gpu::Ray camera_ray = gpu::camera_ray(params, gpu::kPerspective, gpu::kSequenceSobol, x, y);
        if (kind == RayKind::primary) {
            rays.push_back(camera_ray);
            return;
        }
        const gpu::WorldEntry entry = gpu::enter_world(camera_ray, guide.size());
        if (!entry.enters) return;
        const gpu::MarchHit hit = gpu::march(guide, entry.ray, guide.chunks_size);
        if (hit.face >= gpu::kFaceCount) return;
        const glm::vec2 u =
            gpu::sample_2d(gpu::kSequenceSobol, {y * params.width + x, 0, seed}, gpu::kPairOcclusion);
        rays.push_back(gpu::spawn_ray(hit.cell, hit.face, gpu::hit_fraction(entry.ray, hit),
                                      gpu::cosine_on_face(hit.face, u),
                                      kind == RayKind::ao ? kOcclusionReach : gpu::kUnbounded));
    });
    return rays;
}

}  // namespace voxilux
