#include "scene/vox_scene.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

#include "base/checked_cast.h"
#include "scene/vox_animation.h"
#include "scene/vox_cells.h"
#include "scene/vox_instances.h"
#include "scene/vox_material.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxNameBytes = 64;  // a file may give one huge name to many models

// The index in Scene::materials of each palette index, added when a voxel needs it. A material that is in the
// scene already is shared.
class MaterialTable {
  public:
    MaterialTable(Scene& scene, const VoxFile& file)
        : scene_(scene), looks_(vox_materials(file, scene.warnings)) {
        slots_.fill(kNoModel);
    }

    std::uint16_t slot(std::uint8_t index) {
        if (slots_[index] == kNoModel) slots_[index] = add(looks_[index]);
        return static_cast<std::uint16_t>(slots_[index]);
    }

  private:
    std::uint32_t add(const Material& look) {
        auto& materials = scene_.materials;
        const auto same = std::find(materials.begin(), materials.end(), look);
        const auto position = static_cast<std::size_t>(same - materials.begin());
        if (same == materials.end()) {
            if (position == kMaxMaterials)
                throw Error(ExitCode::input_refused,
                            fmt::format("the scene has more than {} materials", kMaxMaterials));
            materials.push_back(look);
        }
        return static_cast<std::uint32_t>(position);
    }

    Scene& scene_;
    std::array<Material, 256> looks_;
    std::array<std::uint32_t, 256> slots_{};
};

std::vector<Voxel> scene_voxels(const std::vector<VoxVoxel>& filled, MaterialTable& table) {
    std::vector<Voxel> voxels;
    voxels.reserve(filled.size());
    for (const VoxVoxel& v : filled)
        voxels.push_back({v.x, v.y, v.z, table.slot(v.index)});
    return voxels;
}

std::string model_name(const VoxFile& file, const VoxInstance& instance) {
    const std::string name(instance_name(file, instance).substr(0, kMaxNameBytes));
    return name.empty() ? fmt::format("model {}", instance.model) : name;
}

// The index in Scene::models of each model of the file, added when an instance first shows it; kNoModel for
// an empty one.
class ModelTable {
  public:
    ModelTable(Scene& scene, const VoxFile& file)
        : scene_(scene), file_(file), materials_(scene, file), slots_(file.models.size()) {}

    std::uint32_t slot(const VoxInstance& instance) {
        auto& known = slots_[instance.model];
        if (!known) known = add(instance);
        return *known;
    }

  private:
    std::uint32_t add(const VoxInstance& instance) {
        const VoxModel& model = file_.models[instance.model];
        const auto filled = filled_voxels(model, cells_);
        if (filled.empty()) return kNoModel;
        scene_.models.push_back({.name = model_name(file_, instance),
                                 .size = model.size,
                                 .voxels = scene_voxels(filled, materials_)});
        return checked_cast<std::uint32_t>(scene_.models.size() - 1, "models of the scene");
    }

    Scene& scene_;
    const VoxFile& file_;
    MaterialTable materials_;
    VoxCells cells_;
    std::vector<std::optional<std::uint32_t>> slots_;
};

// The visible instances of a file, as instances of the scene's models; `model_of` gives the model of each.
std::vector<Instance> shown_instances(const std::vector<VoxInstance>& placed,
                                      const std::function<std::uint32_t(const VoxInstance&)>& model_of,
                                      const std::function<std::size_t(std::uint32_t)>& voxel_count) {
    std::vector<Instance> instances;
    std::uint64_t voxels = 0;
    for (const VoxInstance& instance : placed) {
        const std::uint32_t model = instance.hidden ? kNoModel : model_of(instance);
        if (model == kNoModel) continue;
        voxels += voxel_count(model);
        if (voxels > kVoxMaxInstancedVoxels) {
            throw Error(ExitCode::input_refused,
                        fmt::format("the visible instances have more than {} voxels together",
                                    kVoxMaxInstancedVoxels));
        }
        instances.push_back({model, instance.rotation, instance.translation});
    }
    return instances;
}

}  // namespace

std::vector<Instance> add_vox_models(Scene& scene, const VoxFile& file, int frame) {
    const auto placed = vox_instances(file, frame).value_or_throw(ExitCode::input_refused);
    scene.warnings.insert(scene.warnings.end(), file.warnings.begin(), file.warnings.end());
    ModelTable table(scene, file);
    return shown_instances(
        placed, [&](const VoxInstance& instance) { return table.slot(instance); },
        [&](std::uint32_t model) { return scene.models[model].voxels.size(); });
}

AnimatedVox add_animated_vox(Scene& scene, const VoxFile& file) {
    scene.warnings.insert(scene.warnings.end(), file.warnings.begin(), file.warnings.end());
    ModelTable table(scene, file);
    AnimatedVox added{.graph = graph_of(file)};
    for (std::size_t i = 0; i < file.models.size(); ++i)
        added.models.push_back(table.slot({.model = checked_cast<std::uint32_t>(i, "model")}));
    return added;
}

std::vector<Instance> visible_instances(std::span<const VoxelModel> models, const AnimatedVox& file,
                                        std::int64_t frame) {
    const auto placed = vox_instances(file.graph, frame).value_or_throw(ExitCode::input_refused);
    return shown_instances(
        placed, [&](const VoxInstance& instance) { return file.models[instance.model]; },
        [&](std::uint32_t model) { return models[model].voxels.size(); });
}

AddedVox add_vox(Scene& scene, const VoxFile& file, std::int64_t frame) {
    if (!is_animated(file)) return {.instances = add_vox_models(scene, file, 0)};
    scene.animation.files.push_back(add_animated_vox(scene, file));
    return {.instances = visible_instances(scene.models, scene.animation.files.back(), frame),
            .animated = scene.animation.files.size() - 1};
}

// An instance maps q = v + 1/2 - pivot to the cell floor(R_i q) + t_i. R_i q has half-integer components, so
// the centre of that cell is R_i q + t_i, and the outer map sends it to R R_i q + R t_i + t: again an
// instance.
void place_instances(std::vector<Instance>& into, std::span<const Instance> instances,
                     const Rotation& rotation, glm::ivec3 translation) {
    for (const Instance& inner : instances) {
        const glm::i64vec3 t = glm::i64vec3(rotation.apply(inner.translation)) + glm::i64vec3(translation);
        if (!is_vox_translation(t)) {
            throw Error(ExitCode::input_refused,
                        fmt::format("an instance at {} {} {} is beyond {} voxels from the origin", t.x, t.y,
                                    t.z, kVoxMaxTranslation));
        }
        into.push_back({inner.model, rotation.after(inner.rotation), glm::ivec3(t)});
    }
}

void place_vox(Scene& scene, const AddedVox& added, const Rotation& rotation, glm::ivec3 translation) {
    const std::size_t first = scene.instances.size();
    place_instances(scene.instances, added.instances, rotation, translation);
    if (!added.animated) return;
    scene.animation.placements.push_back({.file = *added.animated,
                                          .rotation = rotation,
                                          .translation = translation,
                                          .first_instance = first,
                                          .instance_count = added.instances.size()});
}

void append_vox(Scene& scene, const VoxFile& file, int frame, const Rotation& rotation,
                glm::ivec3 translation) {
    place_instances(scene.instances, add_vox_models(scene, file, frame), rotation, translation);
}

Scene scene_from_vox(const VoxFile& file, VoxSceneOptions options) {
    Scene scene;
    append_vox(scene, file, options.frame, Rotation{}, glm::ivec3(0));
    return scene;
}

}  // namespace voxilux
