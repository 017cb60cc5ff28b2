#include "renderer/renderer.h"

#include <utility>

#include "base/assert.h"
#include "base/error.h"
#include "frame/footprint.h"
#include "frame/frame.h"
#include "passes/upload.h"
#include "renderer/radius_pilot.h"
#include "scene/atmosphere.h"
#include "scene/scene_camera.h"

namespace voxilux {
namespace {

// All of a scene but its voxels, which the world holds.
Scene without_voxels(const Scene& scene) {
    return {.materials = scene.materials,
            .spheres = scene.spheres,
            .sun = scene.sun,
            .sky = scene.sky,
            .background = scene.background,
            .ground = scene.ground,
            .lens = scene.lens,
            .camera = camera_of(scene),
            .framing_fov_y_deg = scene.framing_fov_y_deg,
            .settings = scene.settings};
}

// The camera that camera_of() gives a scene without one whose voxels fill `box`.
Camera framing_camera_of(const Scene& scene, const Box& box) {
    const glm::dvec2 size(scene.settings.size);
    return framing_camera(united(box, sphere_bounds(scene.spheres)), View::three_quarter, size.x / size.y,
                          scene.framing_fov_y_deg);
}

}  // namespace

Renderer::Renderer(Device& device, const ExecutorOptions& options)
    : limits_(device.limits()), executor_(device, pass_shaders(), options) {}

void Renderer::prepare(const Scene& scene, const PlanRequest& request) {
    PreparedScene next = prepare_scene(scene, request, limits_);
    editing_.reset();
    first_radius_.reset();
    is_framed_ = !scene.camera;
    adopt(std::move(next), scene, request);
}

void Renderer::set_voxels(const Scene& scene) {
    PreparedScene next = prepare_scene(scene, request_, limits_);
    editing_.reset();
    is_framed_ = !scene.camera;
    adopt(std::move(next), scene, request_);
}

void Renderer::prepare_editable(const Scene& scene, const PlanRequest& request) {
    PlanRequest with_room = request;
    with_room.leaves_room = true;
    StepTimes times;
    EditableVoxels voxels(scene);
    times.end_step("flatten");
    PreparedScene next = prepare_scene(scene, measure_scene(scene, voxels.facts()), voxels.world(), with_room,
                                       limits_, std::move(times));
    editing_ = Editing{.voxels = std::move(voxels)};
    first_radius_.reset();
    is_framed_ = !scene.camera;
    adopt(std::move(next), scene, with_room);
}

// Prepares the scene again: with the edited voxels, or as a scene without any.
PreparedScene Renderer::prepare_again(const Scene& scene, const PlanRequest& request) const {
    if (!editing_) return prepare_scene(scene, request, limits_);
    const EditableVoxels& voxels = editing_->voxels;
    return prepare_scene(scene, measure_scene(scene, voxels.facts()), voxels.world(), request, limits_);
}

void Renderer::adopt(PreparedScene next, const Scene& scene, const PlanRequest& request) {
    (void)frame_params(next.plan, scene, next.march_world);  // refuses a camera that is too far away
    FrameState state = steps_ ? steps_->state() : FrameState{};
    state.change_world();
    scene_ = without_voxels(scene);
    request_ = request;
    prepared_ = std::move(next);
    if (editing_) {
        editing_->is_grown = limits_.is_cpu;
        editing_->has_stale_boxes = false;
        editing_->regrowth.reset();
    }
    add_step_times(built_, prepared_->times.steps());
    pending_ = {};
    record_scene_upload(prepared_->plan, scene_, prepared_->march_world, prepared_->lights, pending_);
    start_plan(state);
}

void Renderer::set_camera(const Camera& camera) {
    Scene scene = scene_;
    scene.camera = camera;
    SceneFacts& facts = prepared_->facts;
    // How much air is before the surfaces follows from where the camera stands.
    const float haze = facts.has_atmosphere ? haze_before_surfaces(scene, facts.box) : facts.haze;
    const bool sees_other_air = (haze >= kVisibleHaze) != (facts.haze >= kVisibleHaze);
    if (camera.projection != prepared_->plan.projection || sees_other_air) {
        (void)frame_params(prepared_->plan, scene, prepared_->march_world);  // refuses what is too far away
        facts.haze = haze;
        replan(std::move(scene), request_);
        is_framed_ = false;
        return;
    }
    // A scene without voxels counts its coordinates from a point near the camera.
    is_framed_ = false;
    if (!prepared_->facts.has_voxels) return adopt(prepare_again(scene, request_), scene, request_);
    steps_->start_frame(frame_params(prepared_->plan, scene, prepared_->march_world));
    scene_.camera = camera;
}

void Renderer::set_sun(const Sun& sun) {
    StepTimes times;
    Scene scene = scene_;
    scene.sun = sun;
    if (is_framed_) scene.camera.reset();
    const SceneFacts before = prepared_->facts;
    measure_sun(scene, prepared_->facts);
    try {
        replan(std::move(scene), request_, true);
    } catch (const Error&) {
        prepared_->facts = before;
        throw;
    }
    times.end_step("sun.plan");
    add_step_times(built_, times.steps());
}

void Renderer::change(const RenderSettings& settings, const PlanRequest& wanted) {
    PlanRequest request = wanted;
    request.leaves_room = editing_.has_value();
    Scene scene = scene_;
    scene.settings = settings;
    if (is_framed_) scene.camera.reset();
    replan(std::move(scene), request);
}

// Plans a scene with the same voxels; the structure of the world stays, and if wanted the occlusion cells.
void Renderer::replan(Scene scene, const PlanRequest& request, bool keeps_cells) {
    first_radius_.reset();
    if (!prepared_->facts.has_voxels) return adopt(prepare_again(scene, request), scene, request);
    if (!scene.camera) scene.camera = framing_camera_of(scene, prepared_->facts.box);
    const bool had_voxels = prepared_->plan.has(Effect::voxels);
    // The boxes of the structure on the host may have grown, but an upload needs an unexpanded one.
    if (!had_voxels && editing_) return adopt(prepare_again(scene, request), scene, request);
    WorldFacts world = prepared_->plan.world;
    aim_photons(scene, prepared_->facts, prepared_->march_world.origin, request, prepared_->lights,
                world.lights);
    RenderPlan plan = plan_within_memory(scene, prepared_->facts, world, request, limits_);
    upload();
    const FrameState state = keeps_cells && plan.ao == prepared_->plan.ao ? steps_->state() : FrameState{};
    request_ = request;
    scene_ = std::move(scene);
    prepared_->plan = std::move(plan);
    if (had_voxels)
        record_materials_upload(prepared_->plan, scene_, prepared_->march_world.origin, prepared_->lights,
                                pending_);
    else
        record_scene_upload(prepared_->plan, scene_, prepared_->march_world, prepared_->lights, pending_);
    start_plan(state);
}

// Begins with a new plan. One photon radius serves all cameras, so that frames do not flicker.
void Renderer::start_plan(const FrameState& state) {
    if (prepared_->plan.needs_pilot()) {
        if (!first_radius_) first_radius_ = pilot_radius(*prepared_, scene_, executor());
        prepared_->plan = plan_with_radius(prepared_->plan, *first_radius_);
    }
    steps_.emplace(prepared_->plan, executor_, limits_.is_cpu, state);
    restart();
}

void Renderer::restart(FilmPosition start) {
    steps_->start_frame(frame_params(prepared_->plan, scene_, prepared_->march_world), start);
}

void Renderer::upload() {
    if (pending_.commands().empty()) return;
    StepTimes times;
    add_times(upload_times_, executor_.run(std::exchange(pending_, {})).passes);
    times.end_step("upload");
    add_step_times(built_, times.steps());
}

Executor& Renderer::executor() {
    upload();
    return executor_;
}

FilmSteps& Renderer::ready_film() {
    upload();
    return *steps_;
}

StepResult Renderer::step(double budget_s, std::uint32_t end_samples) {
    return with_uploads(ready_film().step(budget_s, end_samples));
}

StepResult Renderer::step_tile() {
    return with_uploads(ready_film().step_tile());
}

DisplayBuffer Renderer::display(const DisplayLook& look) {
    return ready_film().display(look);
}

void Renderer::set_reference(std::span<const float> radiance) {
    Recording recording;
    record_display_reference(plan(), radiance, recording);
    (void)executor_.run(recording);
}

StepResult Renderer::with_uploads(StepResult step) {
    std::vector<PassTime> passes = std::exchange(upload_times_, {});
    add_times(passes, step.passes);
    step.passes = std::move(passes);
    step.built = std::exchange(built_, {});
    return step;
}

}  // namespace voxilux
