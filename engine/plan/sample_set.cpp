#include "plan/sample_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace voxilux {
namespace {

// So many single samples or more at equal distances are written as one range with a step.
constexpr std::size_t kMinStepped = 3;
constexpr std::uint32_t kNoSample = 0xFFFFFFFF;  // one more than the largest number

std::uint32_t even_numbers_below(std::uint32_t end) {
    return end / 2 + end % 2;
}

// How many ranges from `at` on are single samples at equal distances.
std::size_t stepped_ranges(const std::vector<SampleRange>& ranges, std::size_t at) {
    const auto is_single = [&](std::size_t i) { return ranges[i].end - ranges[i].first == 1; };
    if (at + 1 >= ranges.size() || !is_single(at)) return 1;
    const std::uint32_t step = ranges[at + 1].first - ranges[at].first;
    std::size_t count = 1;
    while (at + count < ranges.size() && is_single(at + count) &&
           ranges[at + count].first - ranges[at + count - 1].first == step)
        ++count;
    return count;
}

// A whole number that `text` starts with, after `before` unless that is 0; it is taken off the text.
std::optional<std::uint32_t> take_number(std::string_view& text, char before) {
    std::string_view rest = text;
    if (before != '\0') {
        if (!rest.starts_with(before)) return {};
        rest.remove_prefix(1);
    }
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error != std::errc()) return {};
    text = rest.substr(static_cast<std::size_t>(end - rest.data()));
    return value;
}

// Takes a range off the text; the empty set where the text does not start with one.
SampleSet take_range(std::string_view& text) {
    const auto first = take_number(text, '\0');
    const auto last = text.starts_with('-') ? take_number(text, '-') : first;
    const auto step = text.starts_with('x') ? take_number(text, 'x') : std::optional(1u);
    if (!first || !last || !step || *last < *first || *last == kNoSample || *step < 1) return {};
    if (*step > 1 && (*last - *first) / *step >= kMaxPartSamples) return {};
    return SampleSet::shard(*first, *step, *last + 1);
}

}  // namespace

void SampleSet::append(SampleRange range) {
    if (range.first >= range.end) return;
    if (!empty() && ranges_.back().end >= range.first)
        ranges_.back().end = std::max(ranges_.back().end, range.end);
    else
        ranges_.push_back(range);
}

SampleSet SampleSet::leading(std::uint32_t count) {
    SampleSet set;
    set.append({0, count});
    return set;
}

SampleSet SampleSet::shard(std::uint32_t index, std::uint32_t shards, std::uint32_t count) {
    SampleSet set;
    if (shards == 1) set.append({index, count});
    if (shards == 1) return set;
    for (std::uint64_t sample = index; sample < count; sample += shards)
        set.append({static_cast<std::uint32_t>(sample), static_cast<std::uint32_t>(sample) + 1});
    return set;
}

std::optional<SampleSet> SampleSet::parse(std::string_view text) {
    std::vector<SampleRange> ranges;
    do {
        if (!ranges.empty()) text.remove_prefix(1);  // the comma
        const SampleSet some = take_range(text);
        if (some.empty()) return {};
        ranges.insert(ranges.end(), some.ranges_.begin(), some.ranges_.end());
    } while (text.starts_with(','));
    if (!text.empty()) return {};
    std::ranges::sort(ranges, {}, &SampleRange::first);
    SampleSet set;
    for (const SampleRange& range : ranges) {
        if (range.first < set.end()) return {};
        set.append(range);
    }
    return set;
}

std::uint32_t SampleSet::size() const {
    std::uint32_t size = 0;
    for (const SampleRange& range : ranges_)
        size += range.end - range.first;
    return size;
}

std::uint32_t SampleSet::sample(std::uint32_t index) const {
    for (const SampleRange& range : ranges_) {
        if (index < range.end - range.first) return range.first + index;
        index -= range.end - range.first;
    }
    return end() + index;
}

SampleSet SampleSet::prefix(std::uint32_t count) const {
    SampleSet set;
    for (const SampleRange& range : ranges_) {
        const std::uint32_t taken = std::min(count, range.end - range.first);
        set.append({range.first, range.first + taken});
        count -= taken;
    }
    set.append({end(), end() + count});
    return set;
}

std::uint32_t SampleSet::even_samples(std::uint32_t count) const {
    std::uint32_t even = 0;
    for (const SampleRange& range : prefix(count).ranges_)
        even += even_numbers_below(range.end) - even_numbers_below(range.first);
    return even;
}

std::optional<std::uint32_t> SampleSet::common(const SampleSet& other) const {
    auto a = ranges_.begin();
    auto b = other.ranges_.begin();
    while (a != ranges_.end() && b != other.ranges_.end()) {
        const std::uint32_t first = std::max(a->first, b->first);
        if (first < std::min(a->end, b->end)) return first;
        (a->end < b->end ? a : b)++;
    }
    return {};
}

void SampleSet::add(const SampleSet& other) {
    std::vector<SampleRange> all;
    std::ranges::merge(ranges_, other.ranges_, std::back_inserter(all), {}, &SampleRange::first,
                       &SampleRange::first);
    ranges_.clear();
    for (const SampleRange& range : all)
        append(range);
}

SampleSet SampleSet::missing(std::uint32_t count) const {
    SampleSet set;
    std::uint32_t next = 0;
    for (const SampleRange& range : ranges_) {
        set.append({next, std::min(range.first, count)});
        next = range.end;
    }
    set.append({next, count});
    return set;
}

std::string SampleSet::text() const {
    std::string text;
    for (std::size_t i = 0; i < ranges_.size();) {
        const auto [first, end] = ranges_[i];
        text += fmt::format("{}{}", text.empty() ? "" : ",", first);
        const std::size_t stepped = stepped_ranges(ranges_, i);
        if (stepped >= kMinStepped)
            text += fmt::format("-{}x{}", ranges_[i + stepped - 1].first, ranges_[i + 1].first - first);
        else if (end - first > 1)
            text += fmt::format("-{}", end - 1);
        i += stepped >= kMinStepped ? stepped : 1;
    }
    return text;
}

}  // namespace voxilux
