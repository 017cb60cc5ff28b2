#include "scene/facts.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/printable.h"
#include "scene/atmosphere.h"
#include "scene/lobe_weights.h"
#include "scene/sky_image.h"

namespace voxilux {
namespace {

bool any_positive(glm::vec3 v) {
    return v.x > 0.0f || v.y > 0.0f || v.z > 0.0f;
}

std::vector<bool> used_by_voxels(const Scene& scene) {
    std::vector<bool> instanced(scene.models.size(), false);
    for (const Instance& instance : scene.instances)
        instanced.at(instance.model) = true;
    std::vector<bool> used(scene.materials.size(), false);
    for (std::size_t m = 0; m < scene.models.size(); ++m) {
        if (!instanced[m]) continue;
        for (const Voxel& voxel : scene.models[m].voxels)
            used.at(voxel.material) = true;
        for (const VoxelBox& box : scene.models[m].boxes)
            used.at(box.material) = true;
    }
    return used;
}

// What a kind of material is shown as, where that is not what its file describes.
std::string_view simplification(const Material& material) {
    if (material.surface == Surface::media) return "a medium is shown as an opaque diffuse surface";
    if (material.surface == Surface::blend)
        return "a blend is shown as a mix of metal, glass and a diffuse surface";
    return "";
}

// The same without microfacets.
std::string_view simplification_of_rough(const Material& material) {
    if (facet_alpha(material) == 0.0f) return "";
    const LobeWeights weights = lobe_weights(material, true);
    return weights.mirror > 0.0f ? "rough metal is shown as a mix of a mirror and a diffuse surface"
                                 : "rough glass is shown clear";
}

// One sentence for each kind of simplification, which names the first of its materials.
class Simplifications {
  public:
    void add(const Material& material, std::string_view words) {
        if (words.empty()) return;
        Kind& kind = kinds_[words];
        if (kind.count++ == 0) kind.first = material.name;
    }

    [[nodiscard]] std::vector<std::string> sentences() const {
        std::vector<std::string> result;
        for (const auto& [words, kind] : kinds_) {
            const std::string more = kind.count > 1 ? fmt::format(" and {} more", kind.count - 1) : "";
            result.push_back(fmt::format("{} ({}{})", words, quoted_name(kind.first), more));
        }
        return result;
    }

  private:
    struct Kind {
        std::string first;
        std::size_t count = 0;
    };
    std::map<std::string_view, Kind> kinds_;
};

bool is_specular(const Material& material) {
    const LobeWeights shares = lobe_weights(material);
    return shares.glass > 0.0f || shares.mirror > 0.0f;
}

void measure_materials(const Scene& scene, std::vector<bool> used, SceneFacts& facts) {
    for (const Sphere& sphere : scene.spheres) {
        used.at(sphere.material) = true;
        facts.has_specular_spheres |= is_specular(scene.materials[sphere.material]);
    }
    Simplifications simplifications, of_rough;
    for (std::size_t m = 0; m < used.size(); ++m) {
        if (!used[m]) continue;
        const Material& material = scene.materials[m];
        ++facts.material_count;
        facts.has_emitters |= any_positive(material.emission);
        facts.has_reflectors |= any_positive(material.albedo);
        const LobeWeights shares = lobe_weights(material);
        facts.has_glass |= shares.glass > 0.0f;
        facts.has_metal |= shares.mirror > 0.0f;
        if (shares.mirror + shares.glass < 1.0f)
            facts.max_albedo =
                std::max(facts.max_albedo,
                         double{std::max({material.albedo.x, material.albedo.y, material.albedo.z})});
        const LobeWeights lobes = lobe_weights(material, true);
        const bool is_rough = facet_alpha(material) > 0.0f;
        facts.has_rough |= is_rough;
        facts.has_sharp |= !is_rough && lobes.mirror + lobes.glass > 0.0f;
        simplifications.add(material, simplification(material));
        of_rough.add(material, simplification_of_rough(material));
    }
    facts.simplified = simplifications.sentences();
    facts.simplified_rough = of_rough.sentences();
}

bool has_sky(const Scene& scene) {
    switch (scene.sky.model) {
        case SkyModel::constant:
            return any_positive(scene.sky.radiance);
        case SkyModel::atmosphere:
            return scene.sun.on && any_positive(scene.sun.irradiance);
        case SkyModel::image:
            return scene.sky.strength > 0.0f && has_light(scene.sky.image);
    }
    VX_ASSERT(false);
}

double cell_count(const Box& box) {
    const glm::dvec3 extent(box.extent());
    return extent.x * extent.y * extent.z;
}

}  // namespace

SceneFacts measure_scene(const Scene& scene) {
    std::uint64_t count = 0;
    for (const Instance& instance : scene.instances) {
        const VoxelModel& model = scene.models.at(instance.model);
        count += model.voxels.size();
        for (const VoxelBox& box : model.boxes)
            count += static_cast<std::uint64_t>(box.cells.volume());
    }
    return measure_scene(scene, {.count = count, .box = voxel_bounds(scene), .used = used_by_voxels(scene)});
}

SceneFacts measure_scene(const Scene& scene, VoxelFacts voxels) {
    if (scene.materials.size() > kMaxMaterials)
        throw Error(ExitCode::input_refused, fmt::format("the scene has {} materials, more than {}",
                                                         scene.materials.size(), kMaxMaterials));
    SceneFacts facts{.voxel_count = voxels.count};
    facts.instance_count = scene.instances.size();
    facts.sphere_count = scene.spheres.size();
    facts.box = voxels.box;
    facts.has_voxels = !facts.box.empty();
    facts.has_ground = scene.ground.on;
    facts.has_spheres = !scene.spheres.empty() || facts.has_ground;
    facts.has_reflectors = facts.has_ground && any_positive(scene.ground.albedo);
    if (facts.has_voxels) {
        facts.extent = facts.box.extent();
        facts.fill_ratio = static_cast<double>(facts.voxel_count) / cell_count(facts.box);
    }
    facts.has_atmosphere = scene.sky.is_atmosphere();
    if (scene.sky.is_image()) facts.sky_image = scene.sky.image.size;
    measure_sun(scene, facts);
    if (facts.has_atmosphere) facts.haze = haze_before_surfaces(scene, facts.box);
    facts.aperture = scene.lens.aperture;
    measure_materials(scene, std::move(voxels.used), facts);
    if (facts.has_ground)
        facts.max_albedo =
            std::max(facts.max_albedo,
                     double{std::max({scene.ground.albedo.x, scene.ground.albedo.y, scene.ground.albedo.z})});
    facts.simplified.insert(facts.simplified.end(), scene.notes.begin(), scene.notes.end());
    return facts;
}

void measure_sun(const Scene& scene, SceneFacts& facts) {
    facts.sun_reaches = any_positive(sunlight(scene));
    facts.has_sky = has_sky(scene);
}

std::string describe(const SceneFacts& facts) {
    const auto yes_no = [](bool fact) { return fact ? "yes" : "no"; };
    std::string text;
    const auto line = [&](const char* name, const std::string& value) {
        text += fmt::format("{}: {}\n", name, value);
    };
    line("voxels", fmt::format("{}", facts.voxel_count));
    line("instances", fmt::format("{}", facts.instance_count));
    line("spheres", fmt::format("{}", facts.sphere_count));
    if (facts.has_ground) line("ground", "yes");
    line("materials used", fmt::format("{}", facts.material_count));
    if (facts.has_voxels) {
        const Box& box = facts.box;
        line("box",
             fmt::format("({} {} {}) to ({} {} {}), {} x {} x {} voxels", box.lo.x, box.lo.y, box.lo.z,
                         box.hi.x, box.hi.y, box.hi.z, facts.extent.x, facts.extent.y, facts.extent.z));
        line("filled", fmt::format("{:.3f} %", 100.0 * facts.fill_ratio));
    } else {
        line("box", "empty");
    }
    line("sun reaches", yes_no(facts.sun_reaches));
    line("sky", yes_no(facts.has_sky));
    if (facts.has_atmosphere) line("atmosphere", "yes");
    if (facts.sky_image.x != 0)
        line("sky image", fmt::format("{} x {} texels", facts.sky_image.x, facts.sky_image.y));
    if (facts.aperture > 0.0) line("aperture", fmt::format("{} voxels", facts.aperture));
    line("emitters", yes_no(facts.has_emitters));
    line("glass", yes_no(facts.has_glass));
    line("metal", yes_no(facts.has_metal));
    if (facts.has_rough) line("rough metal or glass", "yes");
    for (const std::string& sentence : facts.simplified)
        line("note", sentence);
    return text;
}

}  // namespace voxilux
