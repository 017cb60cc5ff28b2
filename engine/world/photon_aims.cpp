#include "world/photon_aims.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "scene/lobe_weights.h"
#include "shared/light.h"
#include "world/aim_grid.h"
#include "world/lights.h"

namespace voxilux {
namespace {

constexpr glm::ivec2 kSunGrid{256, 256};
constexpr glm::ivec2 kEmitterGrid{128, 64};
constexpr std::size_t kMostEmitterMaps = 64;  // eight for each of seven kinds: six faces and spheres
// Positions are rounded on the device, by so much of the largest coordinate.
constexpr double kPlaceMargin = 1e-5;
// Of a direction that is rounded on the device, radians.
constexpr double kAngleMargin = 1e-5;
// Of the rows of a grid over directions, whose ends are floats: a share of the light.
constexpr double kShareMargin = 1e-6;
constexpr double kPi = std::numbers::pi;

RoundedBox grown(RoundedBox box, double margin) {
    box.radius += margin;
    return box;
}

double largest_coordinate(const LightList& lights) {
    const auto reach = [](const glm::dvec3& v) {
        return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    };
    double largest = reach(lights.sun_disc.centre) + lights.sun_disc.radius;
    for (const RoundedBox& box : lights.specular)
        largest = std::max({largest, reach(box.low) + box.radius, reach(box.high) + box.radius});
    return largest;
}

// A box as the sun sees it, on the axes of its disc.
struct Shadow {
    glm::dvec2 low;
    glm::dvec2 high;
    double radius;  // that all of it is rounded by
};

Shadow shadow_of(const RoundedBox& box, const SunDisc& disc, const gpu::Basis& basis, double half_angle) {
    const glm::dvec3 middle = 0.5 * (box.low + box.high) - disc.centre, half = 0.5 * (box.high - box.low);
    const glm::dvec3 across(basis.tangent), along(basis.bitangent);
    const glm::dvec2 centre(glm::dot(middle, across), glm::dot(middle, along));
    const glm::dvec2 extent(glm::dot(half, glm::abs(across)), glm::dot(half, glm::abs(along)));
    // Directions of the sun turn the plane by up to half_angle, and what is on it by a chord.
    const double reach = glm::length(middle) + glm::length(half) + box.radius;
    return {centre - extent, centre + extent, box.radius + 2.0 * std::sin(0.5 * half_angle) * reach};
}

void mark_shadow(const Shadow& shadow, AimGrid& grid) {
    const glm::ivec2 rows = grid.rows(shadow.low.y - shadow.radius, shadow.high.y + shadow.radius);
    for (int row = rows.x; row <= rows.y; ++row) {
        const glm::dvec2 extent = grid.row(row);
        const double off = std::max({shadow.low.y - extent.y, extent.x - shadow.high.y, 0.0});
        const double half = std::sqrt(std::max(shadow.radius * shadow.radius - off * off, 0.0));
        grid.mark(row, shadow.low.x - half, shadow.high.x + half);
    }
}

gpu::AimMap map_of_sun(const Scene& scene, const LightList& lights, double margin,
                       std::vector<gpu::uvec2>& cells) {
    const SunDisc& disc = lights.sun_disc;
    const gpu::Basis basis = gpu::basis_around(scene.sun.direction());
    const double half_angle = static_cast<double>(scene.sun.angular_diameter_deg) * kPi / 360.0;
    std::vector<Shadow> shadows;
    glm::dvec2 low(disc.radius), high(-disc.radius);
    for (const RoundedBox& box : lights.specular) {
        shadows.push_back(shadow_of(grown(box, margin), disc, basis, half_angle));
        low = glm::min(low, shadows.back().low - shadows.back().radius);
        high = glm::max(high, shadows.back().high + shadows.back().radius);
    }
    low = glm::max(low, glm::dvec2(-disc.radius));
    high = glm::min(high, glm::dvec2(disc.radius));
    if (!(low.x < high.x && low.y < high.y)) return {};
    AimGrid grid(low, high, kSunGrid);
    for (const Shadow& shadow : shadows)
        mark_shadow(shadow, grid);
    return grid.append_to(cells);
}

// Heights z between which the cone lies, lower first.
glm::dvec2 heights(const AimCone& cone) {
    const double tilt = std::acos(std::clamp(cone.axis.z, -1.0, 1.0));
    return {std::cos(std::min(tilt + cone.half_angle, kPi)), std::cos(std::max(tilt - cone.half_angle, 0.0))};
}

// What light leaves an emitter in, as a share: the part of its light that leaves above the height z.
struct Emission {
    bool is_face;

    [[nodiscard]] double along(double z) const {
        const double inside = std::clamp(z, is_face ? 0.0 : -1.0, 1.0);
        return is_face ? 1.0 - inside * inside : 0.5 * (1.0 - inside);
    }
    [[nodiscard]] double height(double along) const {
        const double inside = std::clamp(along, 0.0, 1.0);
        return is_face ? std::sqrt(1.0 - inside) : 1.0 - 2.0 * inside;
    }
};

void mark_cone(const AimCone& cone, Emission emission, AimGrid& grid) {
    const glm::dvec2 z = heights(cone);
    const double turn = std::atan2(cone.axis.y, cone.axis.x) / (2.0 * kPi);
    const glm::ivec2 rows = grid.rows(emission.along(z.y), emission.along(z.x));
    for (int row = rows.x; row <= rows.y; ++row) {
        const glm::dvec2 extent = grid.row(row);
        const double half =
            half_turn(cone, emission.height(extent.y), emission.height(extent.x)) / (2.0 * kPi);
        if (half > 0.0) grid.mark_turned(row, turn - half, turn + half);
    }
}

// A direction as off_face() takes it.
glm::dvec3 on_face(std::uint32_t face, const glm::dvec3& direction) {
    const int axis = static_cast<int>(face >> 1u);
    const double out = (face & 1u) == 0 ? -direction[axis] : direction[axis];
    if (axis == 0) return {direction.y, direction.z, out};
    if (axis == 1) return {direction.z, direction.x, out};
    return {direction.x, direction.y, out};
}

constexpr std::uint32_t kSphereKind = 6;  // faces have their own numbers

gpu::AimMap map_of_cluster(const BoxClusters::Cluster& emitters, const LightList& lights, double margin,
                           std::vector<gpu::uvec2>& cells) {
    const Emission emission{emitters.kind != kSphereKind};
    std::vector<AimCone> cones;
    double low = 1.0, high = 0.0;
    for (const RoundedBox& box : lights.specular) {
        AimCone cone = cone_towards(grown(box, margin), emitters.box);
        if (emission.is_face) cone.axis = on_face(emitters.kind, cone.axis);
        const glm::dvec2 z = heights(cone);
        if (emission.is_face && z.y <= 0.0) continue;
        low = std::min(low, emission.along(z.y));
        high = std::max(high, emission.along(z.x));
        cones.push_back(cone);
    }
    if (!(low < high)) return {};
    AimGrid grid({0.0, std::max(low - kShareMargin, 0.0)}, {1.0, std::min(high + kShareMargin, 1.0)},
                 kEmitterGrid);
    for (const AimCone& cone : cones)
        mark_cone(cone, emission, grid);
    return grid.append_to(cells);
}

// An emitter of the list.
struct Emitter {
    std::uint32_t kind;
    glm::ivec3 place;
    RoundedBox box;
    glm::dvec3 power;  // radiance times etendue
};

Emitter emitter_of(const gpu::LightRecord& record, const Scene& scene, std::span<const std::uint32_t> order,
                   glm::ivec3 origin) {
    const gpu::LightParts parts = gpu::light_parts(record.what);
    if (parts.kind == gpu::kLightSphere) {
        const Sphere& sphere = scene.spheres[order[parts.sphere]];
        const glm::dvec3 centre = sphere.centre - glm::dvec3(origin);
        const auto etendue =
            static_cast<double>(gpu::sphere_emission_etendue(static_cast<float>(sphere.radius)));
        return {kSphereKind,
                glm::ivec3(glm::floor(centre)),
                {centre, centre, sphere.radius},
                glm::dvec3(scene.materials.at(sphere.material).emission) * etendue};
    }
    RoundedBox box{glm::dvec3(record.cell), glm::dvec3(record.cell + 1)};
    const int axis = static_cast<int>(parts.face >> 1u);
    box.low[axis] = box.high[axis] = record.cell[axis] + static_cast<int>(parts.face & 1u);
    return {parts.face, record.cell, box,
            glm::dvec3(scene.materials.at(parts.material).emission) * static_cast<double>(gpu::kFaceEtendue)};
}

void aim_emitters(const Scene& scene, const LightList& lights, glm::ivec3 origin, double margin,
                  PhotonAims& aims) {
    const std::vector<std::uint32_t> order = sphere_order(scene);
    BoxClusters clusters(kMostEmitterMaps);
    for (const gpu::LightRecord& record : lights.records) {
        const Emitter emitter = emitter_of(record, scene, order, origin);
        clusters.add(emitter.kind, emitter.place, emitter.box);
    }
    for (const BoxClusters::Cluster& cluster : clusters.clusters())
        aims.maps.push_back(map_of_cluster(cluster, lights, margin, aims.cells));
    std::vector<glm::dvec3> powers;
    std::vector<double> bright;
    for (const gpu::LightRecord& record : lights.records) {
        const Emitter emitter = emitter_of(record, scene, order, origin);
        aims.map_of_light.push_back(1 + clusters.number_of(emitter.kind, emitter.place));
        powers.push_back(emitter.power *
                         static_cast<double>(gpu::aim_area(aims.maps[aims.map_of_light.back()])));
        bright.push_back(powers.back().x + powers.back().y + powers.back().z);
        aims.power += bright.back();
    }
    aims.table = build_alias_table(bright);
    for (std::size_t i = 0; i < aims.table.size(); ++i)
        if (bright[i] > 0.0)
            aims.max_power = glm::max(aims.max_power, powers[i] / static_cast<double>(aims.table[i].pdf));
}

}  // namespace

AimCone cone_towards(const RoundedBox& seen, const RoundedBox& from) {
    // Ways from one to the other: a box that is rounded by both radii.
    const glm::dvec3 low = seen.low - from.high, high = seen.high - from.low;
    const double radius = seen.radius + from.radius;
    const glm::dvec3 middle = 0.5 * (low + high);
    AimCone cone{.half_angle = kPi};
    const double away = glm::length(middle);
    if (!(away > 0.0)) return cone;
    const glm::dvec3 axis = middle / away;
    double widest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                            (corner & 4) != 0 ? high.z : low.z);
        const double length = glm::length(at);
        if (!(length > radius)) return cone;
        const double angle = std::atan2(glm::length(glm::cross(axis, at)), glm::dot(axis, at));
        widest = std::max(widest, angle + std::asin(radius / length));
    }
    // A cone of less than a half space that holds the balls around all corners holds their convex hull.
    if (widest + kAngleMargin < 0.5 * kPi) cone = {axis, widest + kAngleMargin};
    return cone;
}

double half_turn(const AimCone& cone, double low, double high) {
    if (cone.half_angle >= kPi) return kPi;
    const double level = std::cos(cone.half_angle);
    const double slope = std::sqrt(std::max(1.0 - cone.axis.z * cone.axis.z, 0.0));
    // cos(turn) of the rim at height z. It is least where the rim's meridians touch it, or at an end.
    const auto at = [&](double z) {
        const double above = level - z * cone.axis.z;
        const double across = slope * std::sqrt(std::max(1.0 - z * z, 0.0));
        if (above <= -across) return kPi;
        return above >= across ? 0.0 : std::acos(above / across);
    };
    const double touching = std::clamp(cone.axis.z / level, low, high);
    return std::max({at(low), at(high), at(touching)});
}

PhotonAims find_photon_aims(const Scene& scene, const LightList& lights, glm::ivec3 origin) {
    PhotonAims aims;
    const double margin = kPlaceMargin * largest_coordinate(lights);
    aims.maps.push_back(map_of_sun(scene, lights, margin, aims.cells));
    aims.sun_area = static_cast<double>(gpu::aim_area(aims.maps.front()));
    aim_emitters(scene, lights, origin, margin, aims);
    return aims;
}

}  // namespace voxilux
