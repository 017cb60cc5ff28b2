#include "renderer/radius_pilot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "frame/frame.h"
#include "passes/upload.h"
#include "renderer/film_steps.h"
#include "shared/photon_types.h"

namespace voxilux {
namespace {

// With ten photons, the light of a kernel has a relative deviation of a third, which a dozen iterations bring
// below the steps of a display. The Cornell box gets a radius near 2, where its error is lowest.
constexpr double kPilotPhotons = 10.0;
constexpr double kSmallestPilot = 0.0625;  // voxels
constexpr double kPilotGrowth = 4.0;
constexpr int kMaxPilots = 10;  // up to a radius of 16,384 voxels
// With fewer photons in the median kernel, their number is too noisy.
constexpr double kEnoughPhotons = 3.0;
// Where kernels of four times the radius gather less than so many times the photons, they cover the surfaces.
constexpr double kLeastGain = 2.0;
// The longest side of a world of voxels over the largest radius: where few photons arrive, noise is better
// than blur.
constexpr double kFinestParts = 128.0;
constexpr double kUnlitRadius = 1.0;  // voxels, where no photon reaches what is seen

std::vector<float> count_photons(const RenderPlan& pilot, const gpu::FrameParams& params,
                                 Executor& executor) {
    static const std::array<std::string, 1> kept{"photon.radii"};
    FilmSteps steps(pilot, executor, true);
    steps.start_frame(params);
    const DispatchTile tile = steps.next_tile();
    StepResult done;
    auto radii = values_of<gpu::PixelRadius>(steps.take(tile, done, kept), kept[0]);
    radii.resize(std::size_t{tile.row_count} * static_cast<std::size_t>(pilot.settings.size.x));
    std::vector<float> photons;
    for (const gpu::PixelRadius& pixel : radii)
        photons.push_back(pixel.photons);
    return photons;
}

double largest_radius(const PreparedScene& prepared) {
    if (!prepared.plan.has(Effect::voxels)) return std::numeric_limits<double>::infinity();
    const glm::i64vec3 extent = prepared.facts.extent;
    return std::max(1.0, static_cast<double>(std::max({extent.x, extent.y, extent.z})) / kFinestParts);
}

}  // namespace

double median_of_met(std::vector<float> photons) {
    std::erase_if(photons, [](float met) { return !(met > 0.0f); });
    if (photons.empty()) return 0.0;
    const auto middle = photons.begin() + static_cast<std::ptrdiff_t>(photons.size() / 2);
    std::ranges::nth_element(photons, middle);
    return static_cast<double>(*middle);
}

double pilot_radius(const PreparedScene& prepared, const Scene& scene, Executor& executor) {
    const double most = largest_radius(prepared);
    double radius = kSmallestPilot;
    double all_before = 0.0;
    for (int i = 0; i < kMaxPilots; ++i) {
        const RenderPlan pilot = plan_counting(prepared.plan, radius);
        const std::vector<float> photons =
            count_photons(pilot, frame_params(pilot, scene, prepared.march_world), executor);
        const double met = median_of_met(photons);
        const double all = std::reduce(photons.begin(), photons.end(), 0.0);
        if (met >= kEnoughPhotons || (met > 0.0 && (radius >= most || i + 1 == kMaxPilots)))
            return std::min(radius * std::sqrt(kPilotPhotons / met), most);
        if (all_before > 0.0 && all < kLeastGain * all_before)
            return std::min(radius / kPilotGrowth * std::sqrt(std::max(all / all_before, 1.0)), most);
        if (radius >= most) break;
        all_before = all;
        radius *= kPilotGrowth;
    }
    return kUnlitRadius;
}

}  // namespace voxilux
