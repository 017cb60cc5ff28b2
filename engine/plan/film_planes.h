#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plan/render_plan.h"

namespace voxilux {

// A quantity that the film sums exactly, one 64-bit sum per component and pixel.
struct FilmPlane {
    std::string name;  // of its buffers: film.<name>.<film_tile>
    std::uint32_t components = 1;
};

// The planes of a plan, the two halves of the beauty first. Samples alternate between the halves, even ones
// to a; each half has its own sequence (frame/frame.cpp).
[[nodiscard]] std::vector<FilmPlane> film_planes(const RenderPlan& plan);

[[nodiscard]] std::string film_buffer(const std::string& plane, std::uint32_t film_tile);

}  // namespace voxilux
