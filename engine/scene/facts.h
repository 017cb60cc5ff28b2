#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "scene/scene_bounds.h"

namespace voxilux {

// What the plan needs to know of a scene, measured once. Materials count only when a voxel of an instanced
// model or a sphere uses them.
struct SceneFacts {
    std::uint64_t voxel_count = 0;  // over all instances, before later ones overwrite earlier ones
    std::uint64_t instance_count = 0;
    std::uint64_t sphere_count = 0;
    std::uint64_t material_count = 0;  // used ones
    Box box;                           // of the voxels; empty when there are none
    glm::i64vec3 extent{0};            // of `box`, in voxels
    double fill_ratio = 0.0;           // voxel_count / cells of `box`; over 1 where instances overlap

    bool has_voxels = false;
    bool has_spheres = false;  // or a ground, which is one of curvature 0
    bool has_ground = false;
    bool sun_reaches = false;  // switched on, above the horizon, irradiance > 0
    bool has_sky = false;      // radiance > 0, or an atmosphere with a sun
    bool has_atmosphere = false;
    glm::ivec2 sky_image{0};            // columns and rows of an image of the sky, 0 without one
    double aperture = 0.0;              // of the lens, voxels
    bool has_emitters = false;          // a used material with emission > 0
    bool has_glass = false;             // a used material that lets light through
    bool has_metal = false;             // a used material with a mirror lobe
    bool has_reflectors = false;        // a used material that is not black
    bool has_specular_spheres = false;  // of glass or metal
    bool has_rough = false;             // a used material is rough metal or rough glass
    bool has_sharp = false;  // a used material is a mirror or clear glass, where rough ones are shown as such

    float haze = 0.0f;        // share of the farthest surface's light that an atmosphere takes before it
    double max_albedo = 0.0;  // largest channel of a used material that is not all mirror and glass

    // Kinds of used materials that are shown as something simpler: a sentence for each, for the user.
    std::vector<std::string> simplified;
    // Likewise, where microfacets are not shown.
    std::vector<std::string> simplified_rough;

    bool operator==(const SceneFacts&) const = default;
};

// Throws Error(input_refused) when the scene reaches beyond kMaxCoordinate or has over kMaxMaterials.
[[nodiscard]] SceneFacts measure_scene(const Scene& scene);

// The voxels of a scene as its facts see them.
struct VoxelFacts {
    std::uint64_t count = 0;
    Box box;
    std::vector<bool> used;  // one flag per material of the scene
};

// The facts of a scene with these voxels instead of its own.
[[nodiscard]] SceneFacts measure_scene(const Scene& scene, VoxelFacts voxels);

// Measures again what depends on the sun.
void measure_sun(const Scene& scene, SceneFacts& facts);

// One "name: value" line per fact, stable between runs.
[[nodiscard]] std::string describe(const SceneFacts& facts);

}  // namespace voxilux
