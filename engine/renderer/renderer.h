#pragma once

#include <optional>
#include <vector>

#include "passes/display/display.h"
#include "renderer/editable_voxels.h"
#include "renderer/film_steps.h"
#include "renderer/prepared_scene.h"
#include "vk/device.h"

namespace voxilux {

// Renders a scene on a device in steps as small as the caller wants; what a window and a batch render both
// call. It keeps world, pipelines and buffers as long as they are valid. Whatever changes what is seen
// empties the film: after any changes it becomes that of a fresh renderer, bit for bit. Where a pilot chooses
// the first radius of photons, it stays until prepare() or change(), so that frames do not flicker.
// The renderer knows no end, no files and no forecasts.
class Renderer {
  public:
    Renderer(Device& device, const ExecutorOptions& options);
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Puts another scene on the device. What it throws, of a scene or a plan that cannot be, leaves the
    // renderer as it was.
    void prepare(const Scene& scene, const PlanRequest& request);

    // The same for a scene that edit() will change: its voxels are kept, and its structure has room for more.
    void prepare_editable(const Scene& scene, const PlanRequest& request);

    // The same scene with other voxels or another sun, as in an animation. It can no more be edited.
    void set_voxels(const Scene& scene);

    // Another camera on the same scene. One of another projection is a change, and throws as one.
    void set_camera(const Camera& camera);

    // Other settings, techniques or effects, as a renderer of its own would have them; the structure of the
    // world stays, whichever `request` names. Throws as prepare does.
    void change(const RenderSettings& settings, const PlanRequest& request);

    // Other voxels, after prepare_editable; the camera stays. What the edits leave as it was stays on the
    // device, unless the box of all voxels becomes another one or there is no more room. Throws as prepare
    // does, and as EditableVoxels::apply. Returns the edits that take it back.
    std::vector<BoxEdit> edit(std::span<const BoxEdit> edits);

    // The voxels that edit() changes; null where there are none.
    [[nodiscard]] const VoxelWorld* voxels() const { return editing_ ? &editing_->voxels.world() : nullptr; }

    // Empties the film. It goes on from `start`: the samples until then are the caller's.
    void restart(FilmPosition start = {});

    // The steps of the film (film_steps.h), uploads included. prepare() comes first.
    StepResult step(double budget_s, std::uint32_t end_samples = kNoEnd);
    StepResult step_tile();

    // The film so far, read from the device.
    [[nodiscard]] FilmSums read_film() { return ready_film().read(); }

    // Where the film stands, and the film with all uploads done that it depends on.
    [[nodiscard]] const FilmSteps& film() const { return *steps_; }
    [[nodiscard]] FilmSteps& ready_film();

    [[nodiscard]] bool is_prepared() const { return prepared_.has_value(); }
    [[nodiscard]] const RenderPlan& plan() const { return prepared_->plan; }
    [[nodiscard]] const PreparedScene& prepared() const { return *prepared_; }
    // The scene without its voxels, as it is seen now.
    [[nodiscard]] const Scene& scene() const { return scene_; }
    // The film so far as it is shown, in a buffer on the device, for who presents it there. Nothing is read
    // back. Looks that compare need a reference of the size of the image, as record_display_reference().
    DisplayBuffer display(const DisplayLook& look);
    void set_reference(std::span<const float> radiance);

    // The device with all uploads done: for pilots, which leave the film dirty.
    [[nodiscard]] Executor& executor();

  private:
    // Voxels that are edited.
    struct Editing {
        EditableVoxels voxels;
        bool is_grown = false;  // the structure on the host has the boxes that grow on the device
        bool is_stale = false;  // the structure is not that of the voxels
    };

    [[nodiscard]] PreparedScene prepare_again(const Scene& scene, const PlanRequest& request) const;
    void replan(Scene scene, const PlanRequest& request);
    void adopt(PreparedScene next, const Scene& scene, const PlanRequest& request);
    void fetch_boxes();
    [[nodiscard]] bool edit_structure(std::span<const VoxelEdit> cells);
    void start_plan(const FrameState& state);
    void upload();
    [[nodiscard]] StepResult with_uploads(StepResult step);

    DeviceLimits limits_;
    Executor executor_;
    PlanRequest request_;
    Scene scene_;
    bool is_framed_ = false;  // the scene names no camera
    std::optional<PreparedScene> prepared_;
    std::optional<Editing> editing_;
    std::optional<FilmSteps> steps_;
    std::optional<double> first_radius_;  // of photons, once a pilot has found it: one for all cameras
    Recording pending_;                   // what the device lacks
    std::vector<PassTime> upload_times_;  // that no step has told yet
    std::vector<StepTime> built_;         // likewise
};

}  // namespace voxilux
