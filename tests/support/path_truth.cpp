#include "support/path_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/statistics.h"

namespace voxilux::test {
namespace {

using glm::dvec3;

constexpr double kPi = std::numbers::pi;
constexpr int kSureBounces = 4;        // before roulette
constexpr double kMaxSurvival = 0.95;  // so that paths between perfect mirrors end too

struct Tracer {
    const TruthWorld& world;
    const TruthRequest& request;
    TestRandom& random;

    [[nodiscard]] double draw() const { return random.uniform(0.0, 1.0); }
};

// The direction with angle arccos(cosine) from the unit vector `axis`, at a random azimuth.
dvec3 around(const dvec3& axis, double cosine, double sine, double azimuth) {
    const dvec3 other = std::abs(axis.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    const dvec3 u = glm::normalize(glm::cross(axis, other));
    const dvec3 v = glm::cross(axis, u);
    return cosine * axis + sine * (std::cos(azimuth) * u + std::sin(azimuth) * v);
}

// A direction within a cone, 1 - cos of whose half angle is `height`, uniform over its solid angle.
dvec3 in_cone(const Tracer& tracer, const dvec3& axis, double height) {
    const double h = height * tracer.draw();
    return around(axis, 1.0 - h, std::sqrt(h * (2.0 - h)), 2.0 * kPi * tracer.draw());
}

// 1 - cos of the angle under which a sphere is seen from `point`; 0 from inside, where an emitter does not
// shine.
double disc_height(const TruthSphere& emitter, const dvec3& point) {
    const dvec3 way = emitter.centre - point;
    const double sine2 = emitter.radius * emitter.radius / glm::dot(way, way);
    return sine2 < 1.0 ? sine2 / (1.0 + std::sqrt(1.0 - sine2)) : 0.0;
}

TruthRay ray_off(const TruthHit& hit, const dvec3& direction) {
    return {hit.point, direction, hit.sphere, hit.near_cell};
}

dvec3 emission_of(const TruthWorld& world, std::uint32_t material) {
    return world.materials[material].emission;
}

// Radiance / albedo of a diffuse point by the sphere emitters: one of them, chosen by solid angle and r + g +
// b.
dvec3 light_of_spheres(const Tracer& tracer, const TruthHit& at) {
    const TruthWorld& world = tracer.world;
    const auto weight_of = [&](std::size_t i) {
        return brightness(emission_of(world, world.spheres[i].material)) *
               disc_height(world.spheres[i], at.point);
    };
    double total = 0.0;
    for (const std::size_t i : world.emitters)
        total += weight_of(i);
    if (!(total > 0.0)) return dvec3(0.0);
    double left = tracer.draw() * total;
    std::size_t chosen = kNoTruthSphere;
    double weight = 0.0;
    for (const std::size_t i : world.emitters) {
        const double emitter_weight = weight_of(i);
        if (emitter_weight == 0.0) continue;
        chosen = i;
        weight = emitter_weight;
        left -= emitter_weight;
        if (left < 0.0) break;
    }
    const TruthSphere& emitter = world.spheres[chosen];
    const double height = disc_height(emitter, at.point);
    const dvec3 direction = in_cone(tracer, glm::normalize(emitter.centre - at.point), height);
    const double cosine = glm::dot(direction, at.normal);
    if (cosine <= 0.0 || first_hit(world, ray_off(at, direction)).sphere != chosen) return dvec3(0.0);
    return emission_of(world, emitter.material) * (cosine / kPi * 2.0 * kPi * height * total / weight);
}

// The same by the faces of emitting voxels: one of them, chosen by r + g + b, and a point of it.
dvec3 light_of_faces(const Tracer& tracer, const TruthHit& at) {
    const TruthWorld& world = tracer.world;
    if (world.faces.empty()) return dvec3(0.0);
    double total = 0.0;
    for (const TruthFace& face : world.faces)
        total += brightness(emission_of(world, face.material));
    double left = tracer.draw() * total;
    const TruthFace* chosen = &world.faces.back();
    for (const TruthFace& face : world.faces) {
        left -= brightness(emission_of(world, face.material));
        if (left >= 0.0) continue;
        chosen = &face;
        break;
    }
    const dvec3 emission = emission_of(world, chosen->material);
    dvec3 point = dvec3(chosen->cell) + dvec3(tracer.draw(), tracer.draw(), tracer.draw());
    point[chosen->axis] = chosen->cell[chosen->axis] + (chosen->is_high ? 1 : 0);
    const dvec3 way = point - at.point;
    const double square = glm::dot(way, way);
    const dvec3 direction = way / std::sqrt(square);
    const double cosine = glm::dot(direction, at.normal);
    const double emitter_cosine = (chosen->is_high ? -1.0 : 1.0) * direction[chosen->axis];
    if (!(cosine > 0.0 && emitter_cosine > 0.0)) return dvec3(0.0);
    const TruthHit met = first_hit(world, ray_off(at, direction));
    if (!met.is_hit || met.sphere != kNoTruthSphere || !(met.face == *chosen)) return dvec3(0.0);
    return emission * (cosine * emitter_cosine / (kPi * square) * total / brightness(emission));
}

dvec3 light_of_sun(const Tracer& tracer, const TruthHit& at) {
    const TruthWorld& world = tracer.world;
    if (world.sun_irradiance == dvec3(0.0)) return dvec3(0.0);
    const dvec3 direction = in_cone(tracer, world.sun_direction, world.sun_height);
    const double cosine = glm::dot(direction, at.normal);
    if (cosine <= 0.0 || first_hit(world, ray_off(at, direction)).is_hit) return dvec3(0.0);
    return world.sun_irradiance * (cosine / kPi);
}

// Radiance of the sun's disc where a path that a diffuse surface has sent meets it.
dvec3 disc_of_sun(const TruthWorld& world, const dvec3& direction) {
    const bool meets = glm::dot(direction, world.sun_direction) >= 1.0 - world.sun_height;
    return meets && world.sun_height > 0.0 ? world.sun_irradiance / (2.0 * kPi * world.sun_height)
                                           : dvec3(0.0);
}

// Exact reflectance of unpolarised light; 1 beyond the critical angle. Fresnel 1823, as in Born and Wolf
// 1999, "Principles of Optics", section 1.5.2, with the indices on the sides and both cosines.
double fresnel(double n_from, double n_to, double cos_from, double cos_to) {
    const double across = (n_from * cos_from - n_to * cos_to) / (n_from * cos_from + n_to * cos_to);
    const double within = (n_to * cos_from - n_from * cos_to) / (n_to * cos_from + n_from * cos_to);
    return 0.5 * (across * across + within * within);
}

// The outcome of a ray at glass. A lossless surface keeps radiance over n^2, hence `scale`.
struct GlassEvent {
    dvec3 direction;
    bool crosses = true;
    dvec3 colour{1.0};
    double scale = 1.0;
};

GlassEvent cross_glass(const Tracer& tracer, const dvec3& incoming, const TruthHit& hit) {
    GlassEvent event{incoming};
    const TruthInterface between = interface_at(tracer.world, hit);
    if (between.is_none) return event;
    const double n_from = between.n_near, n_to = between.n_far;
    const double cos_from = -glm::dot(incoming, hit.normal);
    const dvec3 along = incoming + cos_from * hit.normal;
    double sine2 = n_from * n_from / (n_to * n_to) * glm::dot(along, along);
    if (tracer.request.squares_the_sine) sine2 *= sine2;
    event.colour = tracer.world.materials[hit.material].albedo;
    const double cos_to = std::sqrt(std::max(0.0, 1.0 - sine2));
    if (sine2 >= 1.0 || tracer.draw() < fresnel(n_from, n_to, cos_from, cos_to)) {
        event.direction = incoming + 2.0 * cos_from * hit.normal;
        event.crosses = false;
        return event;
    }
    const double length = glm::length(along);
    const dvec3 tangent = length > 0.0 ? along / length : dvec3(0.0);
    event.direction = std::sqrt(sine2) * tangent - cos_to * hit.normal;
    event.scale = n_from * n_from / (n_to * n_to);
    return event;
}

// A path and what it has gathered.
struct Path {
    TruthRay ray;
    dvec3 total{0.0};
    dvec3 throughput{1.0};
    double scale = 1.0;           // of radiance, by the media that the path has gone through
    bool counts_emitters = true;  // false where the last diffuse surface has sampled them
    bool is_scattered = false;    // by a diffuse surface: from then on it may find the sun
};

// Sends the path on from the surface that it has met.
void bounce(const Tracer& tracer, Path& path, const TruthHit& hit) {
    const TruthMaterial& material = tracer.world.materials[hit.material];
    const dvec3 incoming = path.ray.direction;
    path.counts_emitters = true;
    if (material.surface == Surface::glass) {
        const GlassEvent event = cross_glass(tracer, incoming, hit);
        path.throughput *= event.colour;
        path.scale *= event.scale;
        path.ray = ray_off(hit, event.direction);
        if (event.crosses) path.ray.cell = hit.far_cell;
    } else if (material.surface == Surface::metal) {
        path.throughput *= material.albedo;
        path.ray = ray_off(hit, incoming - 2.0 * glm::dot(incoming, hit.normal) * hit.normal);
    } else {
        path.throughput *= material.albedo;
        if (path.throughput == dvec3(0.0)) return;
        if (tracer.request.samples_emitters) {
            const dvec3 light =
                light_of_spheres(tracer, hit) + light_of_faces(tracer, hit) + light_of_sun(tracer, hit);
            path.total += path.throughput * path.scale * light;
            path.counts_emitters = false;
        }
        path.is_scattered = true;
        const double sine2 = tracer.draw();
        const double azimuth = 2.0 * kPi * tracer.draw();
        path.ray = ray_off(hit, around(hit.normal, std::sqrt(1.0 - sine2), std::sqrt(sine2), azimuth));
    }
    path.ray.direction = glm::normalize(path.ray.direction);
}

dvec3 radiance_along(const Tracer& tracer, const TruthRay& ray) {
    const TruthWorld& world = tracer.world;
    Path path{ray};
    for (int bounces = 1;; ++bounces) {
        const TruthHit hit = first_hit(world, path.ray);
        if (!hit.is_hit) {
            const bool finds_sun = path.counts_emitters && path.is_scattered;
            const dvec3 sun = finds_sun ? disc_of_sun(world, path.ray.direction) : dvec3(0.0);
            return path.total + path.throughput * path.scale * (world.sky + sun);
        }
        if (hit.is_within) return path.total;
        if (path.counts_emitters && !hit.leaves)
            path.total += path.throughput * path.scale * emission_of(world, hit.material);
        bounce(tracer, path, hit);
        if (path.throughput == dvec3(0.0)) return path.total;
        if (bounces < kSureBounces) continue;
        const double survival =
            std::min(kMaxSurvival, std::max({path.throughput.x, path.throughput.y, path.throughput.z}));
        if (tracer.draw() >= survival) return path.total;
        path.throughput /= survival;
    }
}

}  // namespace

TruthPixel trace_truth_pixel(const TruthWorld& world, const TruthRequest& request, glm::ivec2 pixel) {
    const auto index = static_cast<std::uint64_t>(pixel.y) * static_cast<std::uint64_t>(request.size.x) +
                       static_cast<std::uint64_t>(pixel.x);
    TestRandom seeds(request.seed ^ (index << 20));
    TestRandom random(seeds.bits64());
    const Tracer tracer{world, request, random};
    const glm::ivec3 eye_cell(glm::floor(world.eye));
    dvec3 mean(0.0), squares(0.0);  // Welford 1962
    for (int sample = 1; sample <= request.spp; ++sample) {
        const double across = 2.0 * (pixel.x + tracer.draw()) - request.size.x;
        const double up = request.size.y - 2.0 * (pixel.y + tracer.draw());
        const dvec3 direction =
            glm::normalize(world.view * dvec3(across / request.size.y, up / request.size.y, 1.0));
        const dvec3 value = radiance_along(tracer, {world.eye, direction, kNoTruthSphere, eye_cell});
        const dvec3 difference = value - mean;
        mean += difference / static_cast<double>(sample);
        squares += difference * (value - mean);
    }
    const double spp = request.spp;
    return {mean, squares / (spp * (spp - 1.0))};
}

std::vector<TruthPixel> trace_truth(const TruthWorld& world, const TruthRequest& request) {
    std::vector<TruthPixel> pixels;
    for (int y = 0; y < request.size.y; ++y)
        for (int x = 0; x < request.size.x; ++x)
            pixels.push_back(trace_truth_pixel(world, request, {x, y}));
    return pixels;
}

PictureZ picture_z(std::span<const TruthPixel> traced, std::span<const TruthPixel> expected) {
    constexpr double kRounding = 1e-6;  // of a value that was stored as a float
    constexpr double kLeast = 1e-30;    // for all-black pixels
    PictureZ z;
    dvec3 difference_sum(0.0), variance_sum(0.0);
    for (std::size_t i = 0; i < traced.size(); ++i) {
        const dvec3 difference = traced[i].mean - expected[i].mean;
        const dvec3 rounding = kRounding * expected[i].mean;
        const dvec3 variance =
            traced[i].variance_of_mean + expected[i].variance_of_mean + rounding * rounding + kLeast;
        const dvec3 z2 = difference * difference / variance;
        for (int c = 0; c < 3; ++c) {
            z.rms += z2[c];
            z.beyond_4 += z2[c] > 16.0 ? 1.0 : 0.0;
        }
        difference_sum += difference;
        variance_sum += variance;
    }
    const double count = 3.0 * static_cast<double>(traced.size());
    z.rms = std::sqrt(z.rms / count);
    z.beyond_4 /= count;
    z.of_mean = difference_sum / glm::sqrt(variance_sum);
    return z;
}

}  // namespace voxilux::test
