#include "jobs/price_list/slope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/statistics.h"

namespace voxilux {
namespace {

struct LogPoint {
    double x = 0.0;
    double y = 0.0;
};

std::vector<LogPoint> logarithms(std::span<const PricePoint> points) {
    std::vector<LogPoint> logs;
    for (const PricePoint& point : points)
        if (point.time_s > 0.0 && point.error > 0.0 && std::isfinite(point.error))
            logs.push_back({std::log(point.time_s), std::log(point.error)});
    return logs;
}

}  // namespace

std::optional<Slope> fit_slope(std::span<const PricePoint> points) {
    const std::vector<LogPoint> logs = logarithms(points);
    if (logs.size() < 3) return {};
    const auto n = static_cast<double>(logs.size());
    double mean_x = 0.0, mean_y = 0.0;
    for (const LogPoint& point : logs) {
        mean_x += point.x / n;
        mean_y += point.y / n;
    }
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (const LogPoint& point : logs) {
        xx += (point.x - mean_x) * (point.x - mean_x);
        xy += (point.x - mean_x) * (point.y - mean_y);
        yy += (point.y - mean_y) * (point.y - mean_y);
    }
    // Times that differ by rounding alone have no direction.
    if (!(xx > n * std::numeric_limits<double>::epsilon())) return {};
    const double value = xy / xx;
    const double residual = std::max(yy - value * xy, 0.0);
    const double spread = student_quantile_95(n - 2.0) * std::sqrt(residual / (n - 2.0) / xx);
    return Slope{value, value - spread, value + spread};
}

std::vector<std::size_t> pareto_front(std::span<const PricePoint> points) {
    std::vector<std::size_t> order(points.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        if (points[a].time_s != points[b].time_s) return points[a].time_s < points[b].time_s;
        return points[a].error < points[b].error;
    });
    std::vector<std::size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order) {
        if (!(points[i].error < least)) continue;
        least = points[i].error;
        front.push_back(i);
    }
    return front;
}

}  // namespace voxilux
