#include "scene/animation.h"

#include <algorithm>
#include <utility>

#include "scene/camera_path.h"
#include "scene/scene_camera.h"
#include "scene/vox_scene.h"

namespace voxilux {
namespace {

// Limits of what bounds_of_frames looks at: a file may have any number of keys, and a key any number of
// instances.
constexpr std::size_t kMaxFramedKeys = 256;
constexpr std::size_t kMaxFramedInstances = std::size_t{1} << 22;

// The instances of a placement at `frame`, in the scene.
std::vector<Instance> placed_at(const Animation& animation, const std::vector<VoxelModel>& models,
                                const VoxPlacement& placement, std::int64_t frame) {
    const AnimatedVox& file = animation.files[placement.file];
    std::vector<Instance> placed;
    place_instances(placed, visible_instances(models, file, frame), placement.rotation,
                    placement.translation);
    return placed;
}

glm::dvec2 middle(const Box& box) {
    return 0.5 * (glm::dvec2(box.lo) + glm::dvec2(box.hi));
}

}  // namespace

std::optional<FrameRange> frames_of(const Scene& scene) {
    const Animation& animation = scene.animation;
    if (!animation.camera_keys.empty())
        return FrameRange{animation.camera_keys.front().frame, animation.camera_keys.back().frame};
    if (animation.turntable) return FrameRange{1, animation.turntable->frames};
    std::optional<FrameRange> all;
    for (const AnimatedVox& file : animation.files) {
        const FrameRange range = frames_of(file.graph);
        all = all ? FrameRange{std::min(all->first, range.first), std::max(all->last, range.last)} : range;
    }
    return all;
}

Box bounds_of_frames(const Scene& scene) {
    const Animation& animation = scene.animation;
    if (animation.placements.empty()) return scene_bounds(scene);
    std::vector<Instance> all = scene.instances;
    for (const VoxPlacement& placement : animation.placements) {
        const auto keys = key_frames_of(animation.files[placement.file].graph);
        const std::size_t stride = (keys.size() + kMaxFramedKeys - 1) / kMaxFramedKeys;
        for (std::size_t i = 0; i < keys.size() && all.size() < kMaxFramedInstances; i += stride) {
            const auto shown = placed_at(animation, scene.models, placement, keys[i]);
            all.insert(all.end(), shown.begin(), shown.end());
        }
    }
    return united(voxel_bounds(scene.models, all), sphere_bounds(scene.spheres));
}

FramePlayer::FramePlayer(Scene scene)
    : still_(std::move(scene)), animation_(still_.animation), loaded_(still_.instances) {
    if (animation_.is_still()) return;
    rest_ = camera_of(still_);
    rest_sun_ = still_.sun;
    rest_sky_deg_ = still_.sky.rotation_deg;
    if (animation_.turntable) axis_ = middle(bounds_of_frames(still_));
    still_.animation = {};
}

std::vector<Instance> FramePlayer::instances_at(std::int64_t frame) const {
    std::vector<Instance> all;
    std::size_t copied = 0;
    const auto copy_until = [&](std::size_t end) {
        all.insert(all.end(), loaded_.begin() + static_cast<std::ptrdiff_t>(copied),
                   loaded_.begin() + static_cast<std::ptrdiff_t>(end));
    };
    for (const VoxPlacement& placement : animation_.placements) {
        copy_until(placement.first_instance);
        copied = placement.first_instance + placement.instance_count;
        const auto shown = placed_at(animation_, still_.models, placement, frame);
        all.insert(all.end(), shown.begin(), shown.end());
    }
    copy_until(loaded_.size());
    return all;
}

const Scene& FramePlayer::show(std::int64_t frame) {
    has_new_voxels_ = std::exchange(is_first_, false);
    if (animation_.is_still()) return still_;
    if (!animation_.placements.empty()) {
        std::vector<Instance> instances = instances_at(frame);
        has_new_voxels_ |= instances != still_.instances;
        still_.instances = std::move(instances);
    }
    still_.camera = rest_;
    if (!animation_.camera_keys.empty())
        still_.camera = camera_on_path(animation_.camera_keys, animation_.camera_path, frame);
    else if (animation_.turntable) {
        still_.camera = camera_on_turntable(*animation_.turntable, rest_, axis_, frame);
        const float sun_before = still_.sun.azimuth_deg, sky_before = still_.sky.rotation_deg;
        still_.sun = sun_on_turntable(*animation_.turntable, rest_sun_, frame);
        still_.sky.rotation_deg = azimuth_on_turntable(*animation_.turntable, rest_sky_deg_, frame);
        has_new_light_ = (still_.sun.on && still_.sun.azimuth_deg != sun_before) ||
                         (still_.sky.is_image() && still_.sky.rotation_deg != sky_before);
    }
    return still_;
}

Scene scene_at_frame(const Scene& scene, std::int64_t frame) {
    return FramePlayer(scene).show(frame);
}

}  // namespace voxilux
