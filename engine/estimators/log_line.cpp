#include "estimators/log_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.h"

namespace voxilux {

std::optional<LogLine> fit_log_line(std::span<const double> x, std::span<const double> y) {
    VX_ASSERT_EQ(x.size(), y.size());
    const auto n = static_cast<double>(x.size());
    double mean_x = 0.0, mean_y = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > 0.0 && y[i] > 0.0)) return {};
        mean_x += std::log(x[i]) / n;
        mean_y += std::log(y[i]) / n;
    }
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double dx = std::log(x[i]) - mean_x, dy = std::log(y[i]) - mean_y;
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
    }
    if (!(xx > n * std::numeric_limits<double>::epsilon())) return {};
    const double slope = xy / xx;
    return LogLine{slope, xx, std::max(yy - slope * xy, 0.0)};
}

}  // namespace voxilux
