#pragma once

// What the tests' path tracer sees of a scene, and what a ray meets there, in double precision.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace voxilux::test {

inline constexpr std::size_t kNoTruthSphere = std::numeric_limits<std::size_t>::max();

struct TruthMaterial {
    Surface surface;
    glm::dvec3 albedo;
    glm::dvec3 emission;
    double ior;
};

struct TruthSphere {
    glm::dvec3 centre;
    double radius;
    std::uint32_t material;
};

// The face of an emitting voxel: axis 0..2, and whether it looks along it.
struct TruthFace {
    glm::ivec3 cell;
    int axis;
    bool is_high;
    std::uint32_t material;

    bool operator==(const TruthFace&) const = default;
};

// Voxels in a box of scene cells, x fastest: 0 is empty, else a material and 1.
struct TruthGrid {
    glm::ivec3 low{0};
    glm::ivec3 size{0};
    std::vector<std::uint32_t> cells;

    [[nodiscard]] std::uint32_t at(glm::ivec3 cell) const;
};

// A scene as the tracer sees it. Emitters shine outwards only. Glass reflects or refracts by Fresnel's
// equations and takes its colour from either. A point inside several glass spheres is in the smallest of
// them, else in the glass of its voxel; where one material is on both sides of a surface there is none.
struct TruthWorld {
    std::vector<TruthMaterial> materials;
    std::vector<TruthSphere> spheres;
    std::vector<std::size_t> emitters;  // of `spheres`
    TruthGrid grid;
    std::vector<TruthFace> faces;  // that emit
    glm::dvec3 sky;
    glm::dvec3 sun_direction;
    glm::dvec3 sun_irradiance;  // 0: no sun
    double sun_height;          // 1 - cos of the half angle of its disc
    glm::dvec3 eye;
    glm::dmat3 view;  // columns right, up, forward; the first two as long as the half height of the picture
};

// Throws std::invalid_argument for what the tracer does not know: a scene without camera, rough metal or
// glass, blends and media.
[[nodiscard]] TruthWorld truth_world(const Scene& scene);

// `from` is the sphere that the ray starts on, whose crossing at 0 is known and needs no epsilon, `cell` the
// one that it starts in, for those that start on a face.
struct TruthRay {
    glm::dvec3 origin;
    glm::dvec3 direction;  // unit
    std::size_t from = kNoTruthSphere;
    glm::ivec3 cell;
};

// What a ray meets first.
struct TruthHit {
    bool is_hit = false;
    bool is_within = false;  // the ray starts inside a solid
    double t = std::numeric_limits<double>::infinity();
    glm::dvec3 point;
    glm::dvec3 normal;  // on the side that was hit
    std::size_t sphere = kNoTruthSphere;
    bool leaves = false;   // the sphere, from inside
    glm::ivec3 near_cell;  // in front of a face, and behind it; the same on a sphere
    glm::ivec3 far_cell;
    TruthFace face{};            // when no sphere was hit
    std::uint32_t material = 0;  // whose colour counts
};

[[nodiscard]] TruthHit first_hit(const TruthWorld& world, const TruthRay& ray);

// Indices of refraction where a ray has met glass. `is_none`: there is no surface.
struct TruthInterface {
    bool is_none = false;
    double n_near = 1.0;
    double n_far = 1.0;
};

[[nodiscard]] TruthInterface interface_at(const TruthWorld& world, const TruthHit& hit);

[[nodiscard]] double brightness(const glm::dvec3& colour);

}  // namespace voxilux::test
