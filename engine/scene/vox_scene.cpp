#include "scene/vox_scene.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/checked_cast.h"
#include "scene/vox_cells.h"
#include "scene/vox_instances.h"
#include "scene/vox_material.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kAbsent = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMaxMaterials =
    std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1;  // Voxel::material
constexpr std::size_t kMaxNameBytes = 64;  // a file may give one huge name to many models

// Scene::materials of each palette index, added as voxels ask for them. One that is in the scene already is
// shared.
class MaterialTable {
  public:
    MaterialTable(Scene& scene, const VoxFile& file)
        : scene_(scene), looks_(vox_materials(file, scene.warnings)) {
        slots_.fill(kAbsent);
    }

    std::uint16_t slot(std::uint8_t index) {
        if (slots_[index] == kAbsent) slots_[index] = add(looks_[index]);
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

bool is_in_range(glm::i64vec3 t) {
    return std::max({std::abs(t.x), std::abs(t.y), std::abs(t.z)}) <= kVoxMaxTranslation;
}

}  // namespace

std::vector<Instance> add_vox_models(Scene& scene, const VoxFile& file, int frame) {
    const auto placed = vox_instances(file, frame).value_or_throw(ExitCode::input_refused);
    scene.warnings.insert(scene.warnings.end(), file.warnings.begin(), file.warnings.end());
    MaterialTable table(scene, file);
    VoxCells cells;
    std::vector<std::uint32_t> added(file.models.size(), kAbsent);
    std::vector<bool> is_read(file.models.size(), false);
    std::vector<Instance> instances;
    std::uint64_t voxels = 0;
    for (const VoxInstance& instance : placed) {
        if (instance.hidden) continue;
        const VoxModel& model = file.models[instance.model];
        if (!is_read[instance.model]) {
            is_read[instance.model] = true;
            const auto filled = filled_voxels(model, cells);
            if (!filled.empty()) {
                added[instance.model] =
                    checked_cast<std::uint32_t>(scene.models.size(), "models of the scene");
                scene.models.push_back({.name = model_name(file, instance),
                                        .size = model.size,
                                        .voxels = scene_voxels(filled, table)});
            }
        }
        const std::uint32_t position = added[instance.model];
        if (position == kAbsent) continue;
        voxels += scene.models[position].voxels.size();
        if (voxels > kVoxMaxInstancedVoxels) {
            throw Error(ExitCode::input_refused,
                        fmt::format("the visible instances have more than {} voxels together",
                                    kVoxMaxInstancedVoxels));
        }
        instances.push_back({position, instance.rotation, instance.translation});
    }
    return instances;
}

// An instance maps q = v + 1/2 - pivot to the cell floor(R_i q) + t_i. R_i q has half-integer components, so
// the centre of that cell is R_i q + t_i, and the outer map sends it to R R_i q + R t_i + t: again an
// instance.
void place_instances(Scene& scene, std::span<const Instance> instances, const Rotation& rotation,
                     glm::ivec3 translation) {
    for (const Instance& inner : instances) {
        const glm::i64vec3 t = glm::i64vec3(rotation.apply(inner.translation)) + glm::i64vec3(translation);
        if (!is_in_range(t)) {
            throw Error(ExitCode::input_refused,
                        fmt::format("an instance at {} {} {} is beyond {} voxels from the origin", t.x, t.y,
                                    t.z, kVoxMaxTranslation));
        }
        scene.instances.push_back({inner.model, rotation.after(inner.rotation), glm::ivec3(t)});
    }
}

void append_vox(Scene& scene, const VoxFile& file, int frame, const Rotation& rotation,
                glm::ivec3 translation) {
    place_instances(scene, add_vox_models(scene, file, frame), rotation, translation);
}

Scene scene_from_vox(const VoxFile& file, VoxSceneOptions options) {
    Scene scene;
    append_vox(scene, file, options.frame, Rotation{}, glm::ivec3(0));
    return scene;
}

}  // namespace voxilux
