#pragma once

#include <vector>

namespace voxilux::flip_filter {

using Plane = std::vector<float>;   // [height][width]
using Kernel = std::vector<float>;  // 1D weights of odd length

// Every 2D kernel of FLIP as 1D kernels, sampled at a number of pixels per degree.
struct Kernels {
    Kernel achromatic, red_green;         // blurs of Y and Cx, applied along both axes
    Kernel blue_yellow_1, blue_yellow_2;  // the blur of Cz is the sum of two, each applied along both axes
    Kernel gauss, edge, point;            // a Gaussian and its first and second derivative
};

[[nodiscard]] Kernels make_kernels(double pixels_per_degree);

// Correlates the rows with one kernel and the columns with the other; beyond the border the outermost pixel
// repeats.
[[nodiscard]] Plane filter(const Plane& in, int width, int height, const Kernel& along_row,
                           const Kernel& along_column);

}  // namespace voxilux::flip_filter
