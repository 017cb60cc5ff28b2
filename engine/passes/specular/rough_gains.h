#pragma once

#include <vector>

namespace voxilux {

// The row of gains (shared/bsdf.h) by which a white rough surface keeps all light: kGainPlaces values.
// `alpha` is above 0; `eta` is 0 for metal, for glass its ratio of indices, far / near.
[[nodiscard]] std::vector<float> rough_gains(float alpha, float eta);

}  // namespace voxilux
