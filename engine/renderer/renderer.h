#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "passes/display/display.h"
#include "renderer/editable_voxels.h"
#include "renderer/film_steps.h"
#include "renderer/prepared_scene.h"
#include "vk/device.h"

namespace voxilux {

// Renders a scene on a device in steps as small as the caller wants, for windows and batch renders alike. It
// keeps world, pipelines and buffers as long as they are valid. Whatever changes what is seen empties the
// film, which then becomes that of a fresh renderer, bit for bit. Where a pilot chooses the first photon
// radius, that radius stays until prepare() or change(), so that frames do not flicker. Stop rules, files and
// forecasts are the caller's.
class Renderer {
  public:
    Renderer(Device& device, const ExecutorOptions& options);
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Replaces the scene. Where it throws, because the scene or the plan is impossible, the renderer stays as
    // it was.
    void prepare(const Scene& scene, const PlanRequest& request);

    // The same for a scene that edit() will change: its voxels are kept, and its structure has room for more.
    void prepare_editable(const Scene& scene, const PlanRequest& request);

    // The same scene with other voxels or another sun, as in an animation. It can no longer be edited.
    void set_voxels(const Scene& scene);

    // Another camera for the same scene. One with another projection needs a new plan, and throws as change()
    // does.
    void set_camera(const Camera& camera);

    // The same scene under another sun. Occlusion that frames share stays. Throws as change() does.
    void set_sun(const Sun& sun);

    // Other settings, techniques or effects, as a fresh renderer would have them, except that the structure
    // of the world stays, whichever one `request` names. Throws as prepare does.
    void change(const RenderSettings& settings, const PlanRequest& request);

    // Changes voxels, after prepare_editable; the camera stays. Only what has changed is sent to the device,
    // unless the bounding box of all voxels changes or room is short. Throws as prepare and
    // EditableVoxels::apply do. Returns the edits that undo it.
    std::vector<BoxEdit> edit(std::span<const BoxEdit> edits);

    // Empty boxes around edited voxels are at first smaller than in a structure built anew, and rays take
    // more steps. Takes one step of some milliseconds towards larger ones; false where none is left. Pictures
    // do not depend on them.
    bool regrow_boxes();

    // The voxels that edit() changes; null where there are none.
    [[nodiscard]] const VoxelWorld* voxels() const { return editing_ ? &editing_->voxels.world() : nullptr; }

    // Empties the film, which goes on from `start`; the caller keeps the samples before that.
    void restart(FilmPosition start = {});

    // The steps of the film (film_steps.h), uploads included. prepare() comes first.
    StepResult step(double budget_s, std::uint32_t end_samples = kNoEnd);
    StepResult step_tile();

    // The film so far, read from the device.
    [[nodiscard]] FilmSums read_film() { return ready_film().read(); }

    // The film, for its position; and the film once all uploads that it depends on are done.
    [[nodiscard]] const FilmSteps& film() const { return *steps_; }
    [[nodiscard]] FilmSteps& ready_film();

    [[nodiscard]] bool is_prepared() const { return prepared_.has_value(); }
    [[nodiscard]] const RenderPlan& plan() const { return prepared_->plan; }
    [[nodiscard]] const PreparedScene& prepared() const { return *prepared_; }
    // The scene without its voxels, as it is seen now.
    [[nodiscard]] const Scene& scene() const { return scene_; }
    // The film so far as it is displayed, in a buffer on the device. Nothing is read back. Looks that compare
    // need a reference of the size of the image first (record_display_reference()).
    DisplayBuffer display(const DisplayLook& look);
    void set_reference(std::span<const float> radiance);

    // The device with all uploads done: for pilots, which leave the film dirty.
    [[nodiscard]] Executor& executor();

  private:
    // Voxels that are edited.
    struct Editing {
        EditableVoxels voxels;
        bool is_grown = false;  // the structure on the host has the boxes that grow on the device
        bool is_stale = false;  // the structure does not match the voxels
        bool has_stale_boxes = false;
        std::unique_ptr<Regrowth> regrowth;  // of the structure as it is, once it has begun
    };

    [[nodiscard]] PreparedScene prepare_again(const Scene& scene, const PlanRequest& request) const;
    void replan(Scene scene, const PlanRequest& request, bool keeps_cells = false);
    void adopt(PreparedScene next, const Scene& scene, const PlanRequest& request);
    void fetch_boxes();
    [[nodiscard]] bool edit_structure(std::span<const VoxelEdit> cells, StepTimes& times);
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
    Recording pending_;                   // uploads that the device lacks
    std::vector<PassTime> upload_times_;  // that no step has reported yet
    std::vector<StepTime> built_;         // likewise
};

}  // namespace voxilux
