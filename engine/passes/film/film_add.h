#pragma once

#include "passes/photons/photon.h"
#include "passes/plane.h"
#include "passes/specular/specular.h"

namespace voxilux {

// What a sample found, as the film takes it; each plane may be a constant.
struct FilmInputs {
    Plane first_hits;  // of camera rays, before mirrors and glass
    SpecularPlanes seen;
    Plane ao;
    Plane sky;  // of an atmosphere or an image, else a constant: radiance of misses, irradiance / pi at hits
    Plane air;  // light that the air before the first hits adds
    Plane sun;
    Plane direct;          // irradiance / pi, of emitters
    PhotonPlanes photons;  // irradiance, of photons
};

// Shades the camera rays of sample number `sample` and adds what they saw to every exact sum of the plan's
// film. With `keeps_color` the radiance also goes to the plane "film.color".
void record_film_add(const RenderPlan& plan, const DispatchTile& tile, const FilmInputs& inputs,
                     std::uint32_t sample, bool keeps_color, Recording& recording);

// Adds what guides the denoiser to its sums in the half of the film that the sample belongs to.
void record_denoise_guide(const RenderPlan& plan, const DispatchTile& tile, const FilmInputs& inputs,
                          std::uint32_t sample, Recording& recording);

}  // namespace voxilux
