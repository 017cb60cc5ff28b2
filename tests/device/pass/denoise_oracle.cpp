#include "denoise_oracle.h"

#include <algorithm>
#include <cmath>

namespace voxilux::test {
namespace {

constexpr int kBlock = 16;

double luminance_of_colour(glm::dvec3 v) {
    return 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z;
}

bool sees_one_surface(glm::dvec4 normal) {
    return glm::length(glm::dvec3(normal)) > 0.97;
}

// One half of the film in the filter.
struct OracleHalf {
    std::vector<glm::dvec3> plain, sharp, albedo;
    std::vector<glm::dvec4> normal, guide;
    std::vector<double> weight;  // of the light that surfaces receive
    std::array<std::vector<glm::dvec3>, 4> light;
    std::vector<glm::dvec3> mixed, filtered, result;
};

class Oracle {
  public:
    Oracle(glm::ivec2 size, double share, OracleFault fault) : size_(size), share_(share), fault_(fault) {}

    OracleDenoised run(const std::array<DenoiseHalf, 2>& inputs) {
        for (std::size_t h = 0; h < 2; ++h) {
            halves_[h] = prepared(inputs[h]);
            for (std::size_t level = 0; level < 3; ++level)
                filter(halves_[h], level);
        }
        mix_levels();
        for (OracleHalf& half : halves_)
            find_edges(half);
        blend();
        return judged();
    }

  private:
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] bool is_in(int x, int y) const { return x >= 0 && y >= 0 && x < size_.x && y < size_.y; }
    template <class Visit>
    void each(Visit visit) const {
        for (int y = 0; y < size_.y; ++y)
            for (int x = 0; x < size_.x; ++x)
                visit(x, y, at(x, y));
    }

    [[nodiscard]] OracleHalf prepared(const DenoiseHalf& input) const {
        OracleHalf half;
        for (std::size_t i = 0; i < input.reflected.size(); ++i) {
            const glm::dvec3 albedo(input.albedo[i]);
            const glm::dvec4 normal(input.normal[i]);
            const double bright = luminance_of_colour(albedo), cover = glm::length(glm::dvec3(normal));
            half.plain.emplace_back(input.reflected[i]);
            half.sharp.emplace_back(input.sharp[i]);
            half.albedo.push_back(albedo);
            half.normal.push_back(normal);
            half.guide.push_back(cover > 1e-3 ? normal / cover : normal);
            half.weight.push_back(bright < 1e-6 ? 0.0 : bright * bright);
            half.light[0].push_back(bright < 1e-6
                                        ? glm::dvec3(0.0)
                                        : half.plain[i] / glm::max(albedo, glm::dvec3(0.02 * bright)));
        }
        return half;
    }

    [[nodiscard]] double plane_weight(glm::dvec4 a, glm::dvec4 b) const {
        if (fault_ == OracleFault::ignores_planes) return 1.0;
        return std::pow(std::max(1.0 - 2.5 * glm::dot(b - a, b - a), 0.0), 4.0);
    }

    // Least squares by the normal equations of (1, x, y), with a ridge on the slopes about the mean.
    void filter(OracleHalf& half, std::size_t level) const {
        const int step = 1 << level;
        std::vector<double> weights(half.weight.size());
        half.light[level + 1].resize(half.weight.size());
        each([&](int x, int y, std::size_t i) {
            double sum = 0.0, possible = 0.0;
            std::vector<std::pair<double, std::pair<glm::dvec2, glm::dvec3>>> taps;
            for (int k = 0; k < 25; ++k) {
                const glm::ivec2 offset(k % 5 - 2, k / 5 - 2);
                const int u = x + offset.x * step, v = y + offset.y * step;
                if (!is_in(u, v)) continue;
                const double near = std::exp(-(offset.x * offset.x + offset.y * offset.y) / 2.5);
                const double weight =
                    near * plane_weight(half.guide[i], half.guide[at(u, v)]) * half.weight[at(u, v)];
                possible += near;
                sum += weight;
                taps.push_back({weight, {glm::dvec2(offset) / 2.0, half.light[level][at(u, v)]}});
            }
            weights[i] = sum > 0.0 ? sum / possible : 0.0;
            if (sum > 0.0) half.light[level + 1][i] = fitted(taps, sum, level > 0);
        });
        half.weight = weights;
    }

    static glm::dvec3 fitted(const std::vector<std::pair<double, std::pair<glm::dvec2, glm::dvec3>>>& taps,
                             double sum, bool with_slopes) {
        glm::dvec2 place(0.0);
        glm::dvec3 light(0.0);
        for (const auto& [weight, tap] : taps) {
            place += weight / sum * tap.first;
            light += weight / sum * tap.second;
        }
        if (!with_slopes) return light;
        glm::dmat2 spread(0.03);
        glm::dvec3 with_x(0.0), with_y(0.0);
        for (const auto& [weight, tap] : taps) {
            const glm::dvec2 away = tap.first - place;
            spread += glm::outerProduct(away, away) * (weight / sum);
            with_x += (tap.second - light) * (away.x * weight / sum);
            with_y += (tap.second - light) * (away.y * weight / sum);
        }
        const glm::dvec2 slopes = glm::inverse(spread) * place;
        return glm::max(light - with_x * slopes.x - with_y * slopes.y, glm::dvec3(0.0));
    }

    [[nodiscard]] bool is_one(std::size_t i) const {
        return sees_one_surface(0.5 * (halves_[0].normal[i] + halves_[1].normal[i]));
    }

    // The best weight of y in x + share (y - x) around each pixel, from the blocks around it.
    template <class Light>
    std::vector<double> shares(Light x, Light y, Light guide) const {
        std::vector<glm::dvec2> terms(halves_[0].plain.size());
        for (std::size_t i = 0; i < terms.size(); ++i) {
            const glm::dvec3 sharp = 0.5 * (halves_[0].sharp[i] + halves_[1].sharp[i]);
            const glm::dvec3 seen = sharp + 0.5 * (guide(halves_[0], i) + guide(halves_[1], i));
            const glm::dvec3 scale = 1.0 / (seen * seen + 0.01);
            for (std::size_t h = 0; h < 2; ++h) {
                const OracleHalf &half = halves_[h], &other = halves_[1 - h];
                const glm::dvec3 step = (x(half, i) - y(half, i)) * scale;
                terms[i] += glm::dvec2(glm::dot(x(half, i) - other.plain[i], step),
                                       glm::dot(x(half, i) - y(half, i), step));
            }
        }
        std::vector<double> result(terms.size());
        each([&](int px, int py, std::size_t i) { result[i] = share_around(px, py, i, terms); });
        return result;
    }

    [[nodiscard]] double share_around(int px, int py, std::size_t i,
                                      const std::vector<glm::dvec2>& terms) const {
        glm::dvec2 sum(0.0);
        // Every pixel of a block has the weight that bilinear interpolation between block centres gives its
        // block.
        for (int y = std::max(0, py - 2 * kBlock); y < std::min(size_.y, py + 2 * kBlock + 1); ++y) {
            for (int x = std::max(0, px - 2 * kBlock); x < std::min(size_.x, px + 2 * kBlock + 1); ++x) {
                const std::size_t k = at(x, y);
                if (is_one(k) != is_one(i) || (k == i && fault_ != OracleFault::keeps_own_terms)) continue;
                sum += hat(px, x) * hat(py, y) * terms[k];
            }
        }
        return sum.y > 0.0 ? std::clamp(sum.x / sum.y, 0.0, 1.0) : 0.0;
    }

    static double hat(int pixel, int other) {
        const double centre = (other / kBlock + 0.5) * kBlock;
        return std::max(0.0, 1.0 - std::abs(pixel + 0.5 - centre) / kBlock);
    }

    void mix_levels() {
        using Pick = glm::dvec3 (*)(const OracleHalf&, std::size_t);
        const Pick fine = [](const OracleHalf& h, std::size_t i) { return h.albedo[i] * h.light[1][i]; };
        const Pick middle = [](const OracleHalf& h, std::size_t i) { return h.albedo[i] * h.light[2][i]; };
        const Pick coarse = [](const OracleHalf& h, std::size_t i) { return h.albedo[i] * h.light[3][i]; };
        const std::vector<double> of_middle = shares(fine, middle, middle);
        const std::vector<double> of_coarse = shares(middle, coarse, middle);
        for (OracleHalf& half : halves_) {
            for (std::size_t i = 0; i < of_middle.size(); ++i) {
                const auto& light = half.light;
                half.mixed.push_back(
                    light[1][i] +
                    of_middle[i] * (light[2][i] - light[1][i] + of_coarse[i] * (light[3][i] - light[2][i])));
            }
        }
    }

    void find_edges(OracleHalf& half) const {
        half.filtered.resize(half.plain.size());
        std::vector<double> weights;
        for (const glm::dvec3& albedo : half.albedo) {
            const double bright = luminance_of_colour(albedo);
            weights.push_back(bright < 1e-6 ? 0.0 : bright * bright);
        }
        each([&](int x, int y, std::size_t i) {
            glm::dvec3 light = half.mixed[i];
            if (!sees_one_surface(half.normal[i]) && weights[i] > 0.0)
                light = edge_light(half, weights, x, y);
            half.filtered[i] = weights[i] > 0.0 ? half.albedo[i] * light : half.plain[i];
        });
    }

    [[nodiscard]] glm::dvec3 edge_light(const OracleHalf& half, const std::vector<double>& weights, int x,
                                        int y) const {
        glm::dvec4 mean(0.0);
        glm::dvec3 light(0.0);
        double sum = 0.0;
        std::vector<std::pair<double, std::pair<glm::dvec4, glm::dvec3>>> taps;
        for (int k = 0; k < 25; ++k) {
            const int dx = k % 5 - 2, dy = k / 5 - 2;
            if (!is_in(x + dx, y + dy)) continue;
            const std::size_t tap = at(x + dx, y + dy);
            glm::dvec4 feature = half.normal[tap] - half.normal[at(x, y)];
            feature.w /= 1.0 + std::abs(feature.w);
            const double weight = std::exp(-(dx * dx + dy * dy) / 6.0) * weights[tap] *
                                  (sees_one_surface(half.normal[tap]) ? 1.0 : 0.1);
            taps.push_back({weight, {feature, half.mixed[tap]}});
            sum += weight;
        }
        for (const auto& [weight, tap] : taps) {
            mean += weight / sum * tap.first;
            light += weight / sum * tap.second;
        }
        glm::dmat4 spread(0.01);
        std::array<glm::dvec4, 3> with{};
        for (const auto& [weight, tap] : taps) {
            spread += glm::outerProduct(tap.first - mean, tap.first - mean) * (weight / sum);
            for (std::size_t c = 0; c < 3; ++c) {
                const auto k = static_cast<glm::length_t>(c);
                with[c] += (tap.first - mean) * ((tap.second[k] - light[k]) * weight / sum);
            }
        }
        const glm::dvec4 away = glm::inverse(spread) * mean;
        return glm::max(
            light - glm::dvec3(glm::dot(with[0], away), glm::dot(with[1], away), glm::dot(with[2], away)),
            glm::dvec3(0.0));
    }

    void blend() {
        using Pick = glm::dvec3 (*)(const OracleHalf&, std::size_t);
        const Pick plain = [](const OracleHalf& h, std::size_t i) { return h.plain[i]; };
        const Pick filtered = [](const OracleHalf& h, std::size_t i) { return h.filtered[i]; };
        const std::vector<double> share = shares(plain, filtered, filtered);
        for (OracleHalf& half : halves_)
            for (std::size_t i = 0; i < share.size(); ++i)
                half.result.push_back(half.sharp[i] + glm::mix(half.plain[i], half.filtered[i], share[i]));
    }

    [[nodiscard]] glm::dvec3 squared(glm::dvec3 fa, glm::dvec3 fb, glm::dvec3 a, glm::dvec3 b) const {
        const double rest = 1.0 - share_;
        if (fault_ == OracleFault::claims_without_variance)
            return share_ * (fa - b) * (fa - b) + rest * (fb - a) * (fb - a);
        return share_ * ((fa - b) * (fa - b) - share_ * (a - b) * (a - b)) +
               rest * ((fb - a) * (fb - a) - rest * (a - b) * (a - b)) -
               share_ * rest * (fa - fb) * (fa - fb);
    }

    [[nodiscard]] OracleDenoised judged() const {
        OracleDenoised all;
        for (std::size_t i = 0; i < halves_[0].result.size(); ++i)
            all.picture.push_back(share_ * halves_[0].result[i] + (1.0 - share_) * halves_[1].result[i]);
        each([&](int x, int y, std::size_t i) {
            glm::dvec3 around(0.0);
            double count = 0.0;
            for (int k = 0; k < 9; ++k) {
                if (!is_in(x + k % 3 - 1, y + k / 3 - 1)) continue;
                around += all.picture[at(x + k % 3 - 1, y + k / 3 - 1)];
                count += 1.0;
            }
            const glm::dvec3 value = glm::min(glm::abs(all.picture[i]), glm::abs(around / count));
            const glm::dvec3 scale = 1.0 / (3.0 * (value * value + 0.01));
            const OracleHalf &a = halves_[0], &b = halves_[1];
            const glm::dvec3 raw_a = a.plain[i] + a.sharp[i], raw_b = b.plain[i] + b.sharp[i];
            const glm::dvec3 apart = a.result[i] - b.result[i];
            all.relmse.push_back(glm::dot(squared(a.result[i], b.result[i], raw_a, raw_b), scale));
            all.plain.push_back(glm::dot(squared(raw_a, raw_b, raw_a, raw_b), scale));
            all.variance.push_back(glm::dot(share_ * (1.0 - share_) * apart * apart, scale));
            const auto grey = [](glm::dvec3 v) { return glm::dvec3(luminance_of_colour(v)); };
            all.luminance.push_back(
                squared(grey(a.result[i]), grey(b.result[i]), grey(raw_a), grey(raw_b)).x);
        });
        return all;
    }

    glm::ivec2 size_;
    double share_;
    OracleFault fault_;
    std::array<OracleHalf, 2> halves_;
};

}  // namespace

OracleDenoised oracle_denoised(glm::ivec2 size, double share, const std::array<DenoiseHalf, 2>& halves,
                               OracleFault fault) {
    return Oracle(size, share, fault).run(halves);
}

}  // namespace voxilux::test
