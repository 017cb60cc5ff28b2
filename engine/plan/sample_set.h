#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxilux {

// Most samples of a render in parts: film sums are exact up to here.
inline constexpr std::uint32_t kMaxPartSamples = 1u << 20;

// Samples first, first + 1, ..., end - 1.
struct SampleRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;

    bool operator==(const SampleRange&) const = default;
};

// The samples that a render takes, or that a part of it holds. Samples are numbered from 0 and depend on
// their number alone, so the sums of disjoint sets add up to those of their union. As text: "0-7,16-31x2",
// both numbers of a range included, every second one after an x2.
class SampleSet {
  public:
    SampleSet() = default;  // the empty set

    // The samples from 0 to count - 1.
    [[nodiscard]] static SampleSet leading(std::uint32_t count);
    // Of those, every `shards`th from number `index` on.
    [[nodiscard]] static SampleSet shard(std::uint32_t index, std::uint32_t shards, std::uint32_t count);
    // Nothing for a text that is not a set, names a sample twice, or has more than kMaxPartSamples with a
    // step.
    [[nodiscard]] static std::optional<SampleSet> parse(std::string_view text);

    bool operator==(const SampleSet&) const = default;

    [[nodiscard]] bool empty() const { return ranges_.empty(); }
    [[nodiscard]] bool is_leading() const { return empty() || (ranges_.size() == 1 && first() == 0); }
    [[nodiscard]] std::uint32_t size() const;
    // The smallest number, and one more than the largest; 0 for the empty set.
    [[nodiscard]] std::uint32_t first() const { return empty() ? 0 : ranges_.front().first; }
    [[nodiscard]] std::uint32_t end() const { return empty() ? 0 : ranges_.back().end; }

    // The sample at `index`, and the first `count` samples, in order. Past its end, a set goes on with the
    // numbers after its largest.
    [[nodiscard]] std::uint32_t sample(std::uint32_t index) const;
    [[nodiscard]] SampleSet prefix(std::uint32_t count) const;
    // How many of the first `count` have an even number.
    [[nodiscard]] std::uint32_t even_samples(std::uint32_t count) const;

    // The smallest number in both.
    [[nodiscard]] std::optional<std::uint32_t> common(const SampleSet& other) const;
    void add(const SampleSet& other);
    // The samples from 0 to count - 1 that it lacks.
    [[nodiscard]] SampleSet missing(std::uint32_t count) const;

    [[nodiscard]] std::string text() const;

  private:
    void append(SampleRange range);

    std::vector<SampleRange> ranges_;  // in order; they neither overlap nor touch
};

}  // namespace voxilux
