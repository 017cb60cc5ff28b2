#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "scene/scene_bounds.h"
#include "scene/vox_animation.h"

namespace voxilux {

// The frames of a scene: those of its camera keys, else of one turn of its turntable, else of its .vox files
// together. Nothing for a still scene.
[[nodiscard]] std::optional<FrameRange> frames_of(const Scene& scene);

// The smallest box around the scene as it is and as its .vox files show it at their key frames (256 of them,
// evenly spaced, where there are more).
[[nodiscard]] Box bounds_of_frames(const Scene& scene);

// Shows the frames of a scene one after the other without copying its voxels. Every frame number has an
// image: beyond its keys a camera stays where it is, a turntable keeps turning, and the nodes of a .vox file
// begin again (with _loop) or keep their last key.
class FramePlayer {
  public:
    // Throws Error(input_refused) when a .vox file places an instance out of reach at a key frame.
    explicit FramePlayer(Scene scene);

    // The still scene at `frame`, until the next call. Throws as the constructor does.
    const Scene& show(std::int64_t frame);

    // From now on, show() returns scenes with these settings.
    void change_settings(const RenderSettings& settings) { still_.settings = settings; }

    // Whether the last show() changed the voxels; true of the first.
    [[nodiscard]] bool has_new_voxels() const { return has_new_voxels_; }
    // Whether it moved the sun or an image of the sky.
    [[nodiscard]] bool has_new_light() const { return has_new_light_; }

  private:
    [[nodiscard]] std::vector<Instance> instances_at(std::int64_t frame) const;

    Scene still_;
    Animation animation_;
    std::vector<Instance> loaded_;  // the instances as they were loaded
    Camera rest_;                   // of the turntable at angle 0
    Sun rest_sun_;
    float rest_sky_deg_ = 0.0f;  // rotation of an image of the sky
    glm::dvec2 axis_{0.0};
    bool has_new_voxels_ = true;
    bool has_new_light_ = false;
    bool is_first_ = true;
};

// The still scene at `frame`: what FramePlayer shows.
[[nodiscard]] Scene scene_at_frame(const Scene& scene, std::int64_t frame);

}  // namespace voxilux
