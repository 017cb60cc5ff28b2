#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formats/image.h"
#include "jobs/bench/photon_row.h"
#include "scene/scene.h"

namespace voxilux {

// "photons", "size" and "iterations": 2^12 to 2^18 photons, 64^2 to 512^2 pixels, 1/16 to all of the
// iterations of the job. All other settings stay.
[[nodiscard]] const std::vector<std::string>& photon_series();

struct PhotonBenchOptions {
    std::vector<PhotonVariant> variants = photon_variants();
    std::vector<std::string> growth = photon_series();  // series to measure besides the options
    int rounds = 2;                                     // the times are those of the fastest
    std::string device;
    std::optional<Image> reference;  // for images of the same size
    std::optional<PixelBox> box;     // see PhotonErrors::floor
};

// Renders the job that a scene's settings describe: with each variant in turns, then each series of growth
// with the first variant. `on_rows` gets the rows of one series. Throws Error(input_refused) where the scene
// needs no photons.
void bench_photons(const std::string& name, const Scene& scene, const PhotonBenchOptions& options,
                   const std::function<void(const std::vector<PhotonRow>&)>& on_rows);

}  // namespace voxilux
