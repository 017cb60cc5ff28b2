#include "jobs/price_list/slope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/statistics.h"
#include "estimators/log_line.h"

namespace voxilux {
std::optional<Slope> fit_slope(std::span<const PricePoint> points) {
    std::vector<double> times, errors;
    for (const PricePoint& point : points) {
        if (!(point.time_s > 0.0 && point.error > 0.0 && std::isfinite(point.error))) continue;
        times.push_back(point.time_s);
        errors.push_back(point.error);
    }
    const std::optional<LogLine> line = fit_log_line(times, errors);
    if (!line || times.size() < 3) return {};
    const double degrees = static_cast<double>(times.size()) - 2.0;
    const double spread = student_quantile_95(degrees) * std::sqrt(line->residual / degrees / line->spread);
    return Slope{line->slope, line->slope - spread, line->slope + spread};
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
