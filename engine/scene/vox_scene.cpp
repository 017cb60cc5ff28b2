#include "scene/vox_scene.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>

#include "base/checked_cast.h"
#include "base/parallel_blocks.h"
#include "scene/vox_animation.h"
#include "scene/vox_cells.h"
#include "scene/vox_instances.h"
#include "scene/vox_material.h"

namespace voxilux {
namespace {

constexpr std::size_t kVoxelsOfModelThread = std::size_t{1} << 17;
constexpr std::size_t kMaxNameBytes = 64;  // a file may give one huge name to many models

// The index in Scene::materials of each palette index, added when a voxel needs it. A material that is in the
// scene already is shared.
class MaterialTable {
  public:
    MaterialTable(Scene& scene, const VoxFile& file)
        : scene_(scene), looks_(vox_materials(file, scene.warnings)) {
        slots_.fill(kNoModel);
    }

    void add(std::uint8_t index) {
        if (slots_[index] == kNoModel) slots_[index] = place_of(looks_[index]);
    }
    // By palette index, of those that were added.
    [[nodiscard]] const std::array<std::uint32_t, 256>& slots() const { return slots_; }

  private:
    std::uint32_t place_of(const Material& look) {
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

std::string model_name(const VoxFile& file, const VoxInstance& instance) {
    const std::string name(instance_name(file, instance).substr(0, kMaxNameBytes));
    return name.empty() ? fmt::format("model {}", instance.model) : name;
}

// What a model shows.
class FilledModel {
  public:
    FilledModel(const VoxModel& model, VoxCells& cells) : size_(model.size), voxels_(model.voxels) {
        if (has_oddities(model)) voxels_ = repaired_ = filled_voxels(model, cells);
        std::array<bool, 256> is_known{};
        for (const VoxVoxel& voxel : voxels_) {
            if (!std::exchange(is_known[voxel.index], true)) indices_.push_back(voxel.index);
        }
    }

    FilledModel(const FilledModel&) = delete;
    FilledModel& operator=(const FilledModel&) = delete;

    [[nodiscard]] bool empty() const { return voxels_.empty(); }
    // Of the palette, in the order of their first voxels.
    [[nodiscard]] const std::vector<std::uint8_t>& indices() const { return indices_; }

    // With the material of each index.
    void store(VoxelModel& model, const std::array<std::uint32_t, 256>& materials) const {
        model.size = size_;
        model.voxels.reserve(voxels_.size());
        for (const VoxVoxel& v : voxels_)
            model.voxels.push_back({v.x, v.y, v.z, static_cast<std::uint16_t>(materials[v.index])});
    }

  private:
    glm::ivec3 size_;
    std::vector<VoxVoxel> repaired_;
    std::span<const VoxVoxel> voxels_;
    std::vector<std::uint8_t> indices_;
};

// Adds the models that instances show to a scene, in the order in which they are first shown; none for an
// empty one.
class ModelTable {
  public:
    ModelTable(Scene& scene, const VoxFile& file, std::span<const VoxInstance> instances)
        : file_(file), slots_(file.models.size(), kNoModel) {
        const std::vector<const VoxInstance*> shown = first_shown(instances);
        std::size_t voxels = 0;
        for (const VoxInstance* const instance : shown)
            voxels += file.models[instance->model].voxels.size();
        const unsigned threads = threads_for(voxels, kVoxelsOfModelThread);
        std::vector<std::optional<FilledModel>> filled(shown.size());
        for_each_block(shown.size(), threads, [&] {
            return [&, cells = VoxCells()](std::size_t i) mutable {
                filled[i].emplace(file.models[shown[i]->model], cells);
            };
        });
        MaterialTable materials(scene, file);
        std::vector<std::pair<std::size_t, std::size_t>> added;  // positions in `filled` and in the scene
        for (std::size_t i = 0; i < shown.size(); ++i) {
            if (filled[i]->empty()) continue;
            for (const std::uint8_t index : filled[i]->indices())
                materials.add(index);
            slots_[shown[i]->model] = checked_cast<std::uint32_t>(scene.models.size(), "models of the scene");
            added.emplace_back(i, scene.models.size());
            scene.models.push_back({.name = model_name(file, *shown[i])});
        }
        for_each_block(added.size(), threads, [&] {
            return [&](std::size_t i) {
                filled[added[i].first]->store(scene.models[added[i].second], materials.slots());
            };
        });
    }

    [[nodiscard]] std::uint32_t slot(const VoxInstance& instance) const { return slots_[instance.model]; }

  private:
    // Of each model that is shown the first visible instance.
    [[nodiscard]] std::vector<const VoxInstance*> first_shown(std::span<const VoxInstance> instances) const {
        std::vector<bool> is_shown(file_.models.size(), false);
        std::vector<const VoxInstance*> first;
        for (const VoxInstance& instance : instances) {
            if (instance.hidden || is_shown[instance.model]) continue;
            is_shown[instance.model] = true;
            first.push_back(&instance);
        }
        return first;
    }

    const VoxFile& file_;
    std::vector<std::uint32_t> slots_;  // in Scene::models
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
    const ModelTable table(scene, file, placed);
    return shown_instances(
        placed, [&](const VoxInstance& instance) { return table.slot(instance); },
        [&](std::uint32_t model) { return scene.models[model].voxels.size(); });
}

AnimatedVox add_animated_vox(Scene& scene, const VoxFile& file) {
    scene.warnings.insert(scene.warnings.end(), file.warnings.begin(), file.warnings.end());
    std::vector<VoxInstance> all;
    for (std::size_t i = 0; i < file.models.size(); ++i)
        all.push_back({.model = checked_cast<std::uint32_t>(i, "model")});
    const ModelTable table(scene, file, all);
    AnimatedVox added{.graph = graph_of(file)};
    for (const VoxInstance& one : all)
        added.models.push_back(table.slot(one));
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
