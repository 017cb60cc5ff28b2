#include "support/truth_geometry.h"
#include "support/scene_voxels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace voxilux::test {
namespace {

using glm::dvec3;
using glm::ivec3;

bool is_opaque(const TruthWorld& world, std::uint32_t voxel) {
    return voxel != 0 && world.materials[voxel - 1].surface != Surface::glass;
}

// Where a ray meets another medium or a solid in the grid.
struct GridHit {
    double t = std::numeric_limits<double>::infinity();
    bool is_within = false;
    ivec3 near_cell{0};
    ivec3 far_cell{0};
    int axis = 0;
};

int sign_of(double v) {
    return v > 0.0 ? 1 : -1;
}

// The time at which a ray from outside comes to the box of the grid, and the cell before it.
bool come_to_grid(const TruthGrid& grid, const TruthRay& ray, ivec3& cell) {
    double enter = 0.0, leave = std::numeric_limits<double>::infinity();
    int axis = -1;
    for (int a = 0; a < 3; ++a) {
        const double low = grid.low[a], high = grid.low[a] + grid.size[a];
        if (ray.direction[a] == 0.0) {
            if (ray.origin[a] < low || ray.origin[a] > high) return false;
            continue;
        }
        const double t0 = ((ray.direction[a] > 0.0 ? low : high) - ray.origin[a]) / ray.direction[a];
        const double t1 = ((ray.direction[a] > 0.0 ? high : low) - ray.origin[a]) / ray.direction[a];
        if (t0 > enter) {
            enter = t0;
            axis = a;
        }
        leave = std::min(leave, t1);
    }
    if (!(enter < leave)) return false;
    if (axis < 0) return true;
    for (int a = 0; a < 3; ++a) {
        const double at = ray.origin[a] + enter * ray.direction[a];
        cell[a] = std::clamp(static_cast<int>(std::floor(at)), grid.low[a], grid.low[a] + grid.size[a] - 1);
    }
    cell[axis] = ray.direction[axis] > 0.0 ? grid.low[axis] - 1 : grid.low[axis] + grid.size[axis];
    return true;
}

bool moves_away(const TruthGrid& grid, const TruthRay& ray, const ivec3& cell) {
    for (int a = 0; a < 3; ++a) {
        if (cell[a] < grid.low[a] && ray.direction[a] <= 0.0) return true;
        if (cell[a] >= grid.low[a] + grid.size[a] && ray.direction[a] >= 0.0) return true;
    }
    return false;
}

GridHit walk_grid(const TruthWorld& world, const TruthRay& ray, double t_max) {
    GridHit hit;
    const TruthGrid& grid = world.grid;
    if (grid.cells.empty()) return hit;
    ivec3 cell = ray.cell;
    const ivec3 inside = cell - grid.low;
    const bool starts_outside =
        glm::any(glm::lessThan(inside, ivec3(0))) || glm::any(glm::greaterThanEqual(inside, grid.size));
    if (starts_outside && !come_to_grid(grid, ray, cell)) return hit;
    const std::uint32_t here = grid.at(cell);
    if (is_opaque(world, here)) return {.t = 0.0, .is_within = true};
    while (!moves_away(grid, ray, cell)) {
        double t = std::numeric_limits<double>::infinity();
        int axis = 0;
        for (int a = 0; a < 3; ++a) {
            if (ray.direction[a] == 0.0) continue;
            const double plane = cell[a] + (ray.direction[a] > 0.0 ? 1 : 0);
            const double crossing = (plane - ray.origin[a]) / ray.direction[a];
            if (crossing < t) {
                t = crossing;
                axis = a;
            }
        }
        if (!(t < t_max)) return hit;
        ivec3 next = cell;
        next[axis] += sign_of(ray.direction[axis]);
        if (grid.at(next) != here)
            return {.t = std::max(t, 0.0), .near_cell = cell, .far_cell = next, .axis = axis};
        cell = next;
    }
    return hit;
}

bool is_inside(const TruthSphere& sphere, const dvec3& point) {
    const dvec3 q = point - sphere.centre;
    return glm::dot(q, q) < sphere.radius * sphere.radius;
}

// Whether sphere a decides where both a and b are.
bool is_inner(const TruthWorld& world, std::size_t a, std::size_t b) {
    const double ra = world.spheres[a].radius, rb = world.spheres[b].radius;
    return ra < rb || (ra == rb && a > b);
}

// The glass sphere, other than `but`, whose medium is at `point`.
std::size_t medium_at(const TruthWorld& world, const dvec3& point, std::size_t but) {
    std::size_t found = kNoTruthSphere;
    for (std::size_t i = 0; i < world.spheres.size(); ++i) {
        const TruthSphere& sphere = world.spheres[i];
        const bool is_glass = world.materials[sphere.material].surface == Surface::glass;
        if (i == but || !is_glass || !is_inside(sphere, point)) continue;
        if (found == kNoTruthSphere || is_inner(world, i, found)) found = i;
    }
    return found;
}

double ior_of_voxel(const TruthWorld& world, std::uint32_t voxel) {
    return voxel == 0 ? 1.0 : world.materials[voxel - 1].ior;
}

void refuse(bool unknown, const char* what) {
    if (unknown) throw std::invalid_argument(std::string("the path tracer of the tests knows no ") + what);
}

TruthMaterial truth_material(const Material& material) {
    const bool polished = material.surface == Surface::metal || material.surface == Surface::glass;
    refuse(material.surface == Surface::blend || material.surface == Surface::media, "blend and media");
    refuse(polished && material.roughness != 0.0f, "rough metal or glass");
    return {.surface = material.surface,
            .albedo = dvec3(material.albedo),
            .emission = dvec3(material.emission),
            .ior = static_cast<double>(material.ior)};
}

void fill_grid(const Scene& scene, TruthGrid& grid) {
    ivec3 low(std::numeric_limits<int>::max()), high(std::numeric_limits<int>::min());
    test::for_each_scene_voxel(scene, [&](ivec3 cell, std::uint16_t) {
        low = glm::min(low, cell);
        high = glm::max(high, cell + 1);
    });
    if (high.x <= low.x) return;
    grid.low = low;
    grid.size = high - low;
    grid.cells.resize(static_cast<std::size_t>(grid.size.x) * static_cast<std::size_t>(grid.size.y) *
                      static_cast<std::size_t>(grid.size.z));
    test::for_each_scene_voxel(scene, [&](ivec3 cell, std::uint16_t material) {
        const ivec3 c = cell - low;
        grid.cells[static_cast<std::size_t>(c.x + grid.size.x * (c.y + grid.size.y * c.z))] = material + 1u;
    });
}

void find_faces(TruthWorld& world) {
    const TruthGrid& grid = world.grid;
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
        if (grid.cells[i] == 0) continue;
        const std::uint32_t material = grid.cells[i] - 1;
        if (brightness(world.materials[material].emission) == 0.0) continue;
        const auto n = static_cast<int>(i);
        const ivec3 cell =
            grid.low + ivec3(n % grid.size.x, n / grid.size.x % grid.size.y, n / grid.size.x / grid.size.y);
        for (int axis = 0; axis < 3; ++axis) {
            for (const bool is_high : {false, true}) {
                ivec3 beyond = cell;
                beyond[axis] += is_high ? 1 : -1;
                if (!is_opaque(world, grid.at(beyond)))
                    world.faces.push_back({cell, axis, is_high, material});
            }
        }
    }
}

}  // namespace

double brightness(const dvec3& colour) {
    return colour.x + colour.y + colour.z;
}

std::uint32_t TruthGrid::at(ivec3 cell) const {
    const ivec3 c = cell - low;
    if (glm::any(glm::lessThan(c, ivec3(0))) || glm::any(glm::greaterThanEqual(c, size))) return 0;
    return cells[static_cast<std::size_t>(c.x + size.x * (c.y + size.y * c.z))];
}

TruthWorld truth_world(const Scene& scene) {
    constexpr double kPi = std::numbers::pi;
    refuse(!scene.camera, "default camera");
    const bool has_sun = scene.sun.on && scene.sun.elevation_deg > 0.0f;
    TruthWorld world{.sky = dvec3(scene.sky.radiance),
                     .sun_direction = dvec3(scene.sun.direction()),
                     .sun_irradiance = has_sun ? dvec3(scene.sun.irradiance) : dvec3(0.0),
                     .sun_height = 1.0 - std::cos(scene.sun.angular_diameter_deg * kPi / 360.0),
                     .eye = scene.camera->position};
    for (const Material& material : scene.materials)
        world.materials.push_back(truth_material(material));
    for (const Sphere& sphere : scene.spheres) {
        if (brightness(world.materials.at(sphere.material).emission) > 0.0)
            world.emitters.push_back(world.spheres.size());
        world.spheres.push_back({sphere.centre, sphere.radius, sphere.material});
    }
    fill_grid(scene, world.grid);
    find_faces(world);
    const double yaw = scene.camera->yaw_deg * kPi / 180.0, pitch = scene.camera->pitch_deg * kPi / 180.0;
    const double half = std::tan(scene.camera->fov_y_deg * kPi / 360.0);
    const dvec3 forward(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch));
    const dvec3 right(std::sin(yaw), -std::cos(yaw), 0.0);
    world.view = {half * right, half * glm::cross(right, forward), forward};
    return world;
}

TruthHit first_hit(const TruthWorld& world, const TruthRay& ray) {
    TruthHit first;
    for (std::size_t i = 0; i < world.spheres.size(); ++i) {
        const TruthSphere& sphere = world.spheres[i];
        const dvec3 q = ray.origin - sphere.centre;
        const double b = glm::dot(q, ray.direction);
        double t = -2.0 * b;
        if (i != ray.from) {
            const dvec3 across = q - b * ray.direction;
            const double discriminant = sphere.radius * sphere.radius - glm::dot(across, across);
            if (discriminant < 0.0) continue;
            const double root = std::sqrt(discriminant);
            t = -b - root > 0.0 ? -b - root : -b + root;
        }
        if (t > 0.0 && t < first.t) {
            first.t = t;
            first.sphere = i;
            first.is_hit = true;
        }
    }
    const GridHit grid_hit = walk_grid(world, ray, first.t);
    if (grid_hit.t < first.t) {
        first.sphere = kNoTruthSphere;
        first.is_hit = true;
        first.t = grid_hit.t;
        first.is_within = grid_hit.is_within;
        first.near_cell = grid_hit.near_cell;
        first.far_cell = grid_hit.far_cell;
        first.point = ray.origin + first.t * ray.direction;
        first.normal = dvec3(0.0);
        first.normal[grid_hit.axis] = -sign_of(ray.direction[grid_hit.axis]);
        if (first.is_within) return first;
        const std::uint32_t near = world.grid.at(first.near_cell), far = world.grid.at(first.far_cell);
        first.material = (near != 0 && !is_opaque(world, far) ? near : far) - 1;
        first.face = {first.far_cell, grid_hit.axis, ray.direction[grid_hit.axis] < 0.0, first.material};
    } else if (first.is_hit) {
        const TruthSphere& sphere = world.spheres[first.sphere];
        first.point = ray.origin + first.t * ray.direction;
        const dvec3 outward = (first.point - sphere.centre) / sphere.radius;
        first.leaves = glm::dot(ray.direction, outward) > 0.0;
        first.normal = first.leaves ? -outward : outward;
        first.near_cell = ivec3(glm::floor(first.point));
        first.far_cell = first.near_cell;
        first.material = sphere.material;
    }
    return first;
}

TruthInterface interface_at(const TruthWorld& world, const TruthHit& hit) {
    const std::size_t around = medium_at(world, hit.point, hit.sphere);
    const std::uint32_t near = world.grid.at(hit.near_cell), far = world.grid.at(hit.far_cell);
    if (hit.sphere == kNoTruthSphere)
        return {around != kNoTruthSphere, ior_of_voxel(world, near), ior_of_voxel(world, far)};
    const std::uint32_t outside = around != kNoTruthSphere ? world.spheres[around].material + 1 : near;
    const bool is_none =
        (around != kNoTruthSphere && is_inner(world, around, hit.sphere)) || outside == hit.material + 1;
    const double own = world.materials[hit.material].ior, other = ior_of_voxel(world, outside);
    return {is_none, hit.leaves ? own : other, hit.leaves ? other : own};
}

}  // namespace voxilux::test
