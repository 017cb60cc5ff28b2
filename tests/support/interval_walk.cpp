#include "support/interval_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/assert.h"

namespace voxilux::test {
namespace {

// Relative. A crossing time in floats takes three roundings of 2^-24 each (the sum of plane and fraction, the
// reciprocal of the speed, their product), so two times that differ by more than six of them, here eight,
// have the same order in floats.
constexpr double kUncertain = 8.0 * 0x1p-24;
// The same of one time, in units in the last place, which are at least 2^-24.
constexpr double kMaxUlps = 4.0;

struct State {
    glm::ivec3 crossed{0};
    int last = -1;  // axis of the last crossing
    double t = 0.0;
};

// Distance to a plane along its axis over the speed.
struct Crossing {
    double distance = 0.0;
    bool is_exact = true;  // the distance has no rounding
    double t = 0.0;
};

struct Mover {
    glm::ivec3 start;
    glm::ivec3 step;   // -1, 0 or 1
    glm::dvec3 ahead;  // from the start to the first plane, before rounding
    glm::dvec3 speed;

    explicit Mover(const gpu::Ray& ray) : start(ray.cell), step(0), ahead(0.0), speed(0.0) {
        for (int a = 0; a < 3; ++a) {
            const auto d = static_cast<double>(ray.direction[a]);
            if (std::abs(d) < static_cast<double>(gpu::kMinDirection)) continue;
            step[a] = d < 0.0 ? -1 : 1;
            speed[a] = std::abs(d);
            ahead[a] = static_cast<double>(ray.fraction[a]);
        }
    }

    [[nodiscard]] glm::ivec3 cell(glm::ivec3 crossed) const { return start + crossed * step; }

    [[nodiscard]] Crossing next(int axis, int crossed) const {
        const double whole = step[axis] < 0 ? crossed : crossed + 1;
        const double part = step[axis] < 0 ? ahead[axis] : -ahead[axis];
        Crossing crossing;
        crossing.distance = whole + part;
        crossing.is_exact = crossing.distance - whole == part && crossing.distance - part == whole;
        crossing.t = crossing.distance / speed[axis];
        return crossing;
    }
};

bool has_same_mantissa(double a, double b) {
    int exponent = 0;
    return std::frexp(a, &exponent) == std::frexp(b, &exponent);
}

// Whether rounding may make floats cross `other` before `first`, which comes first in real numbers or by the
// tie rule.
bool may_swap(const Mover& mover, const Crossing& first, const Crossing& other, int axis, int other_axis) {
    if (other.t - first.t > kUncertain * other.t) return false;
    const bool ties_in_floats =
        first.distance == 0.0 || has_same_mantissa(mover.speed[axis], mover.speed[other_axis]);
    return !(first.t == other.t && first.is_exact && other.is_exact && ties_in_floats);
}

class Walk {
  public:
    Walk(const VoxelWorld& world, const gpu::Ray& ray)
        : world_(world), mover_(ray), t_max_(static_cast<double>(ray.t_max)) {}

    std::vector<PossibleHit> run() {
        todo_.push_back({});
        if (!(t_max_ > 0.0)) return {PossibleHit{.cell = mover_.start}};
        while (!todo_.empty()) {
            const State state = todo_.back();
            todo_.pop_back();
            advance(state);
        }
        return hits_;
    }

  private:
    void advance(State state) {
        for (;;) {
            const glm::ivec3 cell = mover_.cell(state.crossed);
            if (!world_.contains(cell)) return add({.cell = cell});
            if (world_.get(cell) != VoxelWorld::kEmpty) return add({cell, face_of(state.last), state.t});
            if (!cross(state)) return;
        }
    }

    // Makes one crossing and keeps the other possible ones for later. False when the ray certainly ends here.
    bool cross(State& state) {
        std::array<Crossing, 3> next;
        int axis = -1;
        for (int a = 0; a < 3; ++a) {
            if (mover_.step[a] == 0) continue;
            next[static_cast<std::size_t>(a)] = mover_.next(a, state.crossed[a]);
            if (axis < 0 || next[static_cast<std::size_t>(a)].t < next[static_cast<std::size_t>(axis)].t)
                axis = a;
        }
        VX_ASSERT(axis >= 0);
        const Crossing& first = next[static_cast<std::size_t>(axis)];
        if (first.t >= t_max_ * (1.0 - kUncertain)) {
            add({.cell = mover_.cell(state.crossed)});
            if (first.t > t_max_ * (1.0 + kUncertain)) return false;
        }
        for (int a = 0; a < 3; ++a) {
            const Crossing& other = next[static_cast<std::size_t>(a)];
            if (a == axis || mover_.step[a] == 0 || !may_swap(mover_, first, other, axis, a)) continue;
            fork(state, a, other.t);
        }
        ++state.crossed[axis];
        state.last = axis;
        state.t = first.t;
        return true;
    }

    void fork(const State& state, int axis, double t) {
        State other{state.crossed, axis, t};
        ++other.crossed[axis];
        const auto is_same = [&](const State& s) { return s.crossed == other.crossed && s.last == axis; };
        if (std::ranges::any_of(forks_, is_same)) return;
        forks_.push_back(other);
        todo_.push_back(other);
    }

    [[nodiscard]] gpu::uint face_of(int axis) const {
        if (axis < 0) return gpu::kFaceInside;
        return static_cast<gpu::uint>(2 * axis + (mover_.step[axis] > 0 ? 0 : 1));
    }

    void add(const PossibleHit& hit) { hits_.push_back(hit); }

    const VoxelWorld& world_;
    Mover mover_;
    double t_max_;
    std::vector<State> todo_;
    std::vector<State> forks_;
    std::vector<PossibleHit> hits_;
};

}  // namespace

std::vector<PossibleHit> interval_walk(const VoxelWorld& world, const gpu::Ray& ray) {
    return Walk(world, ray).run();
}

std::string disagreement(const std::vector<PossibleHit>& possible, const gpu::MarchHit& hit) {
    for (const PossibleHit& one : possible) {
        if (one.face != hit.face) continue;
        if (one.face == gpu::kFaceMiss) return "";
        const auto t = static_cast<float>(one.t);
        const double ulp = static_cast<double>(std::nextafter(t, gpu::kUnbounded) - t);
        if (one.cell == hit.cell && std::abs(static_cast<double>(hit.t) - one.t) <= kMaxUlps * ulp) return "";
    }
    std::string text = fmt::format("hit face {} of ({}, {}, {}) at {}; possible:", hit.face, hit.cell.x,
                                   hit.cell.y, hit.cell.z, hit.t);
    for (const PossibleHit& one : possible)
        text += fmt::format(" [face {} of ({}, {}, {}) at {}]", one.face, one.cell.x, one.cell.y, one.cell.z,
                            one.t);
    return text;
}

}  // namespace voxilux::test
