#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "shared/two_float.h"
#include "support/statistics.h"

namespace voxilux::test {

struct TwoFloatCase {
    gpu::TwoFloat a;
    gpu::TwoFloat b;
};

// Relative error that two_float.h promises for one operation.
inline constexpr double kTwoFloatError = 0x1p-44;

// The nearest two-float to a double.
inline gpu::TwoFloat to_two_float(double v) {
    const float hi = static_cast<float>(v);
    return gpu::two_float(hi, static_cast<float>(v - static_cast<double>(hi)));
}

inline long double value_of(gpu::TwoFloat v) {
    return static_cast<long double>(v.hi) + static_cast<long double>(v.lo);
}

// |got - want| / |want|; where want is 0, got itself.
inline double relative_error(gpu::TwoFloat got, long double want) {
    const long double error = std::abs(value_of(got) - want);
    return static_cast<double>(want == 0.0L ? error : error / std::abs(want));
}

// Operands of magnitude 2^-35 to 2^35 with random signs, plus pairs that nearly cancel in a sum.
inline std::vector<TwoFloatCase> two_float_cases(int count) {
    TestRandom random(10);
    const auto draw = [&] {
        const double sign = random.bits32() % 2 == 0 ? 1.0 : -1.0;
        return sign * random.uniform(1.0, 2.0) * std::exp2(std::floor(random.uniform(-35.0, 35.0)));
    };
    std::vector<TwoFloatCase> cases;
    for (int i = 0; i < count; ++i) {
        const double a = draw();
        const double b = i % 8 == 0 ? -a * (1.0 + random.uniform(-1.0, 1.0) * 0x1p-20) : draw();
        cases.push_back({to_two_float(a), to_two_float(b)});
    }
    return cases;
}

}  // namespace voxilux::test
