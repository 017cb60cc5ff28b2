#include "passes/specular/rough_gains.h"

#include <algorithm>
#include <cmath>

#include "shared/bsdf.h"

namespace voxilux {
namespace {

constexpr std::size_t kPlaces = gpu::kGainPlaces;
// Microfacets of a direction: points of a Fibonacci lattice (Niederreiter 1992, "Random Number Generation and
// Quasi-Monte Carlo Methods", section 5.1), half a step inside: at the corner of the square a microfacet
// stands upright, and its part, a thousandth, would be lost at any roughness. Points of a grid would lie
// along the border of what is masked.
constexpr int kFacets = 987;
constexpr int kFacetStep = 610;
// Halves the error in each round, or more: the last one changes no float.
constexpr int kRounds = 24;
// Least cosine of a row. At the horizon weights are 0 / 0; their limit is finite.
constexpr float kLowest = 1e-5f;

// The light that each place of a row sends by one scattering: to the places on its own side, and beyond.
struct Scattering {
    float alpha = 0.0f;
    float eta = 0.0f;
    std::vector<double> reflected = std::vector<double>(kPlaces * kPlaces);
    std::vector<double> refracted = std::vector<double>(kPlaces);
};

void add_reflected(float cosine, double light, double* to, float alpha) {
    const float place = gpu::gain_place(cosine, alpha) * static_cast<float>(kPlaces - 1);
    const auto low = std::min(static_cast<std::size_t>(place), kPlaces - 2);
    const double part = static_cast<double>(place) - static_cast<double>(low);
    to[low] += light * (1.0 - part);
    to[low + 1] += light * part;
}

// What a microfacet sends of the light that leaves `place` in the direction `outward`.
void scatter(glm::vec3 outward, glm::vec3 facet, std::size_t place, Scattering& scattering) {
    const auto [alpha, eta] = std::pair(scattering.alpha, scattering.eta);
    const gpu::Dielectric surface = eta == 0.0f ? gpu::Dielectric{.reflectance = 1.0f, .is_total = true}
                                                : gpu::dielectric(glm::dot(outward, facet), eta);
    const float up = gpu::mirror_direction(-outward, facet).z;
    if (up > 0.0f)
        add_reflected(up, double{surface.reflectance} * double{gpu::unmasked(outward.z, up, alpha)} / kFacets,
                      &scattering.reflected[place * kPlaces], alpha);
    if (surface.is_total) return;
    const float down = -gpu::refracted_direction(-outward, facet, eta, surface).z;
    if (down > 0.0f)
        scattering.refracted[place] +=
            double{1.0f - surface.reflectance} * double{gpu::unmasked(outward.z, down, alpha)} / kFacets;
}

Scattering scatter_once(float alpha, float eta) {
    Scattering scattering{.alpha = alpha, .eta = eta};
    for (std::size_t i = 0; i < kPlaces; ++i) {
        const float place = static_cast<float>(i) / static_cast<float>(kPlaces - 1);
        const float cosine = std::clamp(gpu::gain_cosine(place, alpha), kLowest, 1.0f);
        const glm::vec3 outward(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
        for (int k = 0; k < kFacets; ++k) {
            const int step = k * kFacetStep % kFacets;
            const glm::vec2 u = (glm::vec2(k, step) + 0.5f) / float{kFacets};
            scatter(outward, gpu::sample_facet(outward, {0.0f, 0.0f, 1.0f}, alpha, u), i, scattering);
        }
    }
    return scattering;
}

// What each place sends, where what arrives is multiplied by `gains`.
std::vector<double> sent(const Scattering& scattering, const std::vector<double>& gains) {
    std::vector<double> light = scattering.refracted;
    for (std::size_t from = 0; from < kPlaces; ++from)
        for (std::size_t to = 0; to < kPlaces; ++to)
            light[from] += scattering.reflected[from * kPlaces + to] * gains[to];
    return light;
}

// Solves gain(o) sum over i of reflected(o, i) gain(i) = 1. Source: Knight and Ruiz 2013, "A fast algorithm
// for matrix balancing", for the fixed point, of which half steps are taken.
std::vector<double> balanced(const Scattering& scattering) {
    std::vector<double> gains(kPlaces, 1.0);
    for (int round = 0; round < kRounds; ++round) {
        const std::vector<double> light = sent(scattering, gains);
        for (std::size_t i = 0; i < kPlaces; ++i)
            gains[i] = std::sqrt(gains[i] / light[i]);
    }
    return gains;
}

}  // namespace

std::vector<float> rough_gains(float alpha, float eta) {
    const Scattering scattering = scatter_once(alpha, eta);
    if (eta == 0.0f) {
        const std::vector<double> gains = balanced(scattering);
        return {gains.begin(), gains.end()};
    }
    std::vector<float> gains;
    for (const double light : sent(scattering, std::vector<double>(kPlaces, 1.0)))
        gains.push_back(static_cast<float>(1.0 / light));
    return gains;
}

}  // namespace voxilux
