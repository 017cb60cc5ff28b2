#include "support/path_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "support/statistics.h"

namespace voxilux::test {
namespace {

using glm::dvec3;

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr double kPi = std::numbers::pi;
constexpr int kSureBounces = 4;         // before roulette
constexpr double kMostSurvival = 0.95;  // so that paths between perfect mirrors end too

// `from` is the sphere that the ray starts on: its crossing at 0 is known and needs no epsilon.
struct Ray {
    dvec3 origin;
    dvec3 direction;  // unit
    std::size_t from;
};

struct Hit {
    std::size_t sphere = kNone;
    double t = std::numeric_limits<double>::infinity();
};

struct Tracer {
    const TruthWorld& world;
    const TruthRequest& request;
    TestRandom& random;

    [[nodiscard]] double draw() const { return random.uniform(0.0, 1.0); }
};

Hit first_hit(const TruthWorld& world, const Ray& ray) {
    Hit first;
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
        if (t > 0.0 && t < first.t) first = {i, t};
    }
    return first;
}

// The direction with angle arccos(cosine) from the unit vector `axis`, at a random azimuth.
dvec3 around(const dvec3& axis, double cosine, double sine, double azimuth) {
    const dvec3 other = std::abs(axis.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    const dvec3 u = glm::normalize(glm::cross(axis, other));
    const dvec3 v = glm::cross(axis, u);
    return cosine * axis + sine * (std::cos(azimuth) * u + std::sin(azimuth) * v);
}

// 1 - cos of the angle under which a sphere is seen from `point`; 0 from inside, where a lamp does not shine.
double disc_height(const TruthSphere& lamp, const dvec3& point) {
    const dvec3 way = lamp.centre - point;
    const double sine2 = lamp.radius * lamp.radius / glm::dot(way, way);
    return sine2 < 1.0 ? sine2 / (1.0 + std::sqrt(1.0 - sine2)) : 0.0;
}

double brightness(const TruthSphere& lamp) {
    return lamp.emission.x + lamp.emission.y + lamp.emission.z;
}

// Radiance / albedo that a diffuse point sends on of the light that reaches it straight from a lamp.
dvec3 direct_light(const Tracer& tracer, const dvec3& point, std::size_t on, const dvec3& normal) {
    const TruthWorld& world = tracer.world;
    double total = 0.0;
    for (const std::size_t i : world.lamps)
        total += brightness(world.spheres[i]) * disc_height(world.spheres[i], point);
    if (!(total > 0.0)) return dvec3(0.0);
    double left = tracer.draw() * total;
    std::size_t chosen = kNone;
    double weight = 0.0;
    for (const std::size_t i : world.lamps) {
        const double lamp_weight = brightness(world.spheres[i]) * disc_height(world.spheres[i], point);
        if (lamp_weight == 0.0) continue;
        chosen = i;
        weight = lamp_weight;
        left -= lamp_weight;
        if (left < 0.0) break;
    }
    const TruthSphere& lamp = world.spheres[chosen];
    const double height = disc_height(lamp, point);
    const double h = height * tracer.draw();
    const dvec3 direction = around(glm::normalize(lamp.centre - point), 1.0 - h, std::sqrt(h * (2.0 - h)),
                                   2.0 * kPi * tracer.draw());
    const double cosine = glm::dot(direction, normal);
    if (cosine <= 0.0 || first_hit(world, {point, direction, on}).sphere != chosen) return dvec3(0.0);
    return lamp.emission * (cosine / kPi * 2.0 * kPi * height * total / weight);
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
    std::size_t found = kNone;
    for (std::size_t i = 0; i < world.spheres.size(); ++i) {
        const TruthSphere& sphere = world.spheres[i];
        if (i == but || sphere.surface != Surface::glass || !is_inside(sphere, point)) continue;
        if (found == kNone || is_inner(world, i, found)) found = i;
    }
    return found;
}

// Exact reflectance of unpolarised light; 1 beyond the critical angle. Fresnel 1823, as in Born and Wolf
// 1999, "Principles of Optics", section 1.5.2, with the indices on the sides and both cosines.
double fresnel(double n_from, double n_to, double cos_from, double cos_to) {
    const double across = (n_from * cos_from - n_to * cos_to) / (n_from * cos_from + n_to * cos_to);
    const double within = (n_to * cos_from - n_from * cos_to) / (n_to * cos_from + n_from * cos_to);
    return 0.5 * (across * across + within * within);
}

// What happened to a ray at glass. Radiance over n^2 is what a lossless surface keeps, hence `scale`.
struct GlassEvent {
    dvec3 direction;
    dvec3 colour{1.0};
    double scale = 1.0;
};

GlassEvent cross_glass(const Tracer& tracer, const Ray& ray, const dvec3& point, std::size_t on) {
    const TruthWorld& world = tracer.world;
    const TruthSphere& glass = world.spheres[on];
    GlassEvent event{ray.direction};
    const std::size_t outside = medium_at(world, point, on);
    if (outside != kNone &&
        (is_inner(world, outside, on) || world.spheres[outside].material == glass.material))
        return event;
    const dvec3 outward = (point - glass.centre) / glass.radius;
    const bool leaves = glm::dot(ray.direction, outward) > 0.0;
    const dvec3 normal = leaves ? -outward : outward;
    const double n_outside = outside == kNone ? 1.0 : world.spheres[outside].ior;
    const double n_from = leaves ? glass.ior : n_outside;
    const double n_to = leaves ? n_outside : glass.ior;
    const double cos_from = -glm::dot(ray.direction, normal);
    const dvec3 along = ray.direction + cos_from * normal;
    double sine2 = n_from * n_from / (n_to * n_to) * glm::dot(along, along);
    if (tracer.request.squares_the_sine) sine2 *= sine2;
    event.colour = glass.albedo;
    const double cos_to = std::sqrt(std::max(0.0, 1.0 - sine2));
    if (sine2 >= 1.0 || tracer.draw() < fresnel(n_from, n_to, cos_from, cos_to)) {
        event.direction = ray.direction + 2.0 * cos_from * normal;
        return event;
    }
    const double length = glm::length(along);
    const dvec3 tangent = length > 0.0 ? along / length : dvec3(0.0);
    event.direction = std::sqrt(sine2) * tangent - cos_to * normal;
    event.scale = n_from * n_from / (n_to * n_to);
    return event;
}

dvec3 radiance_along(const Tracer& tracer, Ray ray) {
    const TruthWorld& world = tracer.world;
    dvec3 total(0.0), throughput(1.0);
    double scale = 1.0;        // of radiance, by the media that the path has gone through
    bool counts_lamps = true;  // false where the last diffuse surface has sampled them
    for (int bounce = 1;; ++bounce) {
        const Hit hit = first_hit(world, ray);
        if (hit.sphere == kNone) return total + throughput * scale * world.sky;
        const TruthSphere& sphere = world.spheres[hit.sphere];
        const dvec3 point = ray.origin + hit.t * ray.direction;
        const dvec3 outward = (point - sphere.centre) / sphere.radius;
        const bool leaves = glm::dot(ray.direction, outward) > 0.0;
        const dvec3 normal = leaves ? -outward : outward;
        if (counts_lamps && !leaves) total += throughput * scale * sphere.emission;
        counts_lamps = true;
        if (sphere.surface == Surface::glass) {
            const GlassEvent event = cross_glass(tracer, ray, point, hit.sphere);
            throughput *= event.colour;
            scale *= event.scale;
            ray = {point, event.direction, hit.sphere};
        } else if (sphere.surface == Surface::metal) {
            throughput *= sphere.albedo;
            ray = {point, ray.direction - 2.0 * glm::dot(ray.direction, normal) * normal, hit.sphere};
        } else {
            throughput *= sphere.albedo;
            if (throughput == dvec3(0.0)) return total;
            if (tracer.request.samples_lamps) {
                total += throughput * scale * direct_light(tracer, point, hit.sphere, normal);
                counts_lamps = false;
            }
            const double sine2 = tracer.draw();
            const double azimuth = 2.0 * kPi * tracer.draw();
            ray = {point, around(normal, std::sqrt(1.0 - sine2), std::sqrt(sine2), azimuth), hit.sphere};
        }
        ray.direction = glm::normalize(ray.direction);
        if (bounce < kSureBounces) continue;
        const double survival = std::min(kMostSurvival, std::max({throughput.x, throughput.y, throughput.z}));
        if (tracer.draw() >= survival) return total;
        throughput /= survival;
    }
}

void refuse(bool unknown, const char* what) {
    if (unknown) throw std::invalid_argument(std::string("the path tracer of the tests knows no ") + what);
}

TruthSphere truth_sphere(const Scene& scene, const Sphere& sphere) {
    const Material& material = scene.materials.at(sphere.material);
    const bool polished = material.surface == Surface::metal || material.surface == Surface::glass;
    refuse(material.surface == Surface::blend || material.surface == Surface::media, "blend and media");
    refuse(polished && material.roughness != 0.0f, "rough metal or glass");
    return {.centre = sphere.centre,
            .radius = sphere.radius,
            .surface = material.surface,
            .albedo = dvec3(material.albedo),
            .emission = dvec3(material.emission),
            .ior = static_cast<double>(material.ior),
            .material = sphere.material};
}

}  // namespace

TruthWorld truth_world(const Scene& scene) {
    refuse(!scene.instances.empty(), "voxels");
    refuse(scene.sun.on, "sun");
    refuse(!scene.camera, "default camera");
    TruthWorld world{.sky = dvec3(scene.sky.radiance), .eye = scene.camera->position};
    for (const Sphere& sphere : scene.spheres)
        world.spheres.push_back(truth_sphere(scene, sphere));
    for (std::size_t i = 0; i < world.spheres.size(); ++i) {
        if (brightness(world.spheres[i]) > 0.0) world.lamps.push_back(i);
    }
    const double yaw = scene.camera->yaw_deg * kPi / 180.0, pitch = scene.camera->pitch_deg * kPi / 180.0;
    const double half = std::tan(scene.camera->fov_y_deg * kPi / 360.0);
    const dvec3 forward(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch));
    const dvec3 right(std::sin(yaw), -std::cos(yaw), 0.0);
    world.view = {half * right, half * glm::cross(right, forward), forward};
    return world;
}

TruthPixel trace_truth_pixel(const TruthWorld& world, const TruthRequest& request, glm::ivec2 pixel) {
    const auto index = static_cast<std::uint64_t>(pixel.y) * static_cast<std::uint64_t>(request.size.x) +
                       static_cast<std::uint64_t>(pixel.x);
    TestRandom seeds(request.seed ^ (index << 20));
    TestRandom random(seeds.bits64());
    const Tracer tracer{world, request, random};
    dvec3 mean(0.0), squares(0.0);  // Welford 1962
    for (int sample = 1; sample <= request.spp; ++sample) {
        const double across = 2.0 * (pixel.x + tracer.draw()) - request.size.x;
        const double up = request.size.y - 2.0 * (pixel.y + tracer.draw());
        const dvec3 direction =
            glm::normalize(world.view * dvec3(across / request.size.y, up / request.size.y, 1.0));
        const dvec3 value = radiance_along(tracer, {world.eye, direction, kNone});
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
    constexpr double kLeast = 1e-30;    // where all is black
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
