#include "estimators/log_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace voxilux {
namespace {

TEST(LogLine, power_law_gives_its_exponent_and_no_residual) {
    const std::vector<double> x{1.0, 3.0, 10.0, 50.0};
    for (const double power : {-0.5, 0.0, 1.0, 2.0}) {
        std::vector<double> y;
        for (const double value : x)
            y.push_back(7.0 * std::pow(value, power));
        EXPECT_NEAR(fit_log_line(x, y).value().slope, power, 1e-12);
        EXPECT_NEAR(fit_log_line(x, y).value().residual, 0.0, 1e-12);
        y[1] *= 2.0;
        EXPECT_GT(fit_log_line(x, y).value().residual, 0.1);
    }
}

TEST(LogLine, spread_is_that_of_the_logarithms_of_x) {
    const std::vector<double> x{1.0, std::exp(2.0)}, y{1.0, 1.0};
    EXPECT_NEAR(fit_log_line(x, y).value().spread, 2.0, 1e-12);
}

TEST(LogLine, points_without_a_logarithm_or_a_direction_have_none) {
    EXPECT_FALSE(fit_log_line(std::vector{1.0, 2.0}, std::vector{0.0, 4.0}));
    EXPECT_FALSE(fit_log_line(std::vector{-1.0, 2.0}, std::vector{1.0, 4.0}));
    EXPECT_FALSE(fit_log_line(std::vector{2.0, 2.0}, std::vector{3.0, 4.0}));
    EXPECT_FALSE(fit_log_line(std::vector{2.0}, std::vector{3.0}));
    EXPECT_FALSE(fit_log_line(std::vector<double>{}, std::vector<double>{}));
}

}  // namespace
}  // namespace voxilux
