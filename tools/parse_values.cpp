#include "parse_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "base/colour.h"
#include "base/error.h"
#include "base/nearest_name.h"
#include "scene/settings.h"
#include "scene/vox_animation.h"

namespace voxilux {
namespace {

// A finite number from 0 up and what follows it; nothing when the text does not start with one.
std::optional<std::pair<double, std::string_view>> leading_number(std::string_view text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || !(value >= 0.0) || !std::isfinite(value)) return {};
    return std::pair(value, std::string_view(rest, static_cast<std::size_t>(end - rest)));
}

double seconds_in(char unit) {
    return unit == 'h' ? 3600.0 : unit == 'm' ? 60.0 : unit == 's' ? 1.0 : 0.0;
}

// The four whole numbers of "x0,y0,x1,y1", or nothing when the text is something else.
std::optional<std::array<int, 4>> parse_box(std::string_view text) {
    std::array<int, 4> edges{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto [rest, error] = std::from_chars(at, end, edges[i]);
        const bool is_last = i + 1 == edges.size();
        if (error != std::errc() || (is_last ? rest != end : rest == end || *rest != ',')) return {};
        at = is_last ? end : rest + 1;
    }
    return edges;
}

template <class T, std::size_t N>
using Names = std::array<std::pair<std::string_view, T>, N>;

// Values that are numbered in the order of their names.
template <class T, std::size_t N>
Names<T, N> in_order(const std::array<std::string_view, N>& names) {
    Names<T, N> table;
    for (std::size_t i = 0; i < N; ++i)
        table[i] = {names[i], static_cast<T>(i)};
    return table;
}

template <class T, std::size_t N>
std::optional<T> value_named(std::string_view typed, const Names<T, N>& table) {
    for (const auto& [name, value] : table)
        if (name == typed) return value;
    return {};
}

// For flags of two or three words, which `all` lists for the message.
template <class T, std::size_t N>
T parse_word(std::string_view flag, std::string_view typed, const Names<T, N>& table, std::string_view all) {
    if (const std::optional<T> value = value_named(typed, table)) return *value;
    refuse(fmt::format("{}: '{}' is not {}", flag, typed, all));
}

template <class T, std::size_t N>
T parse_name(std::string_view flag, std::string_view typed, const Names<T, N>& table) {
    if (const std::optional<T> value = value_named(typed, table)) return *value;
    std::array<std::string_view, N> names;
    std::ranges::transform(table, names.begin(), [](const auto& row) { return row.first; });
    refuse(fmt::format("{}: there is no '{}'{}", flag, typed, name_hint(typed, names)));
}

}  // namespace

void refuse(const std::string& complaint) {
    throw Error(ExitCode::usage, complaint);
}

glm::ivec2 parse_size(std::string_view flag, std::string_view text) {
    glm::ivec2 size(0);
    const char* const end = text.data() + text.size();
    const auto [cross, width_error] = std::from_chars(text.data(), end, size.x);
    if (width_error == std::errc() && cross != end && *cross == 'x') {
        const auto [rest, height_error] = std::from_chars(cross + 1, end, size.y);
        if (height_error == std::errc() && rest == end && size.x > 0 && size.y > 0) return size;
    }
    refuse(fmt::format("{}: '{}' is not WIDTHxHEIGHT in pixels, such as 1280x720", flag, text));
}

PixelWindow parse_window(std::string_view flag, std::string_view text) {
    const auto box = parse_box(text);
    if (!box) refuse(fmt::format("{}: '{}' is not X0,Y0,X1,Y1 in pixels", flag, text));
    const auto [x0, y0, x1, y1] = *box;
    return {{x0, y0}, {x1, y1}};
}

PixelBox parse_pixel_box(std::string_view flag, std::string_view text) {
    const PixelWindow window = parse_window(flag, text);
    return {window.first.x, window.first.y, window.end.x, window.end.y};
}

FrameList parse_frames(std::string_view text) {
    FrameList frames{.is_sequence = true};
    std::string_view rest = text;
    // A whole number after `before`; false when the text goes on in another way.
    const auto read = [&](char before, std::int64_t& value) {
        if (before != '\0') {
            if (!rest.starts_with(before)) return false;
            rest.remove_prefix(1);
        }
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
        if (error != std::errc() || rest.starts_with('-')) return false;
        rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
        return true;
    };
    const bool has_first = read('\0', frames.first);
    frames.last = frames.first;
    const bool is_range = has_first && !rest.empty();
    if (!has_first || (is_range && !read('-', frames.last)) || (!rest.empty() && !read('x', frames.step)) ||
        !rest.empty())
        refuse(fmt::format("--frames: '{}' is not FIRST-LAST or FIRST-LASTxSTEP, such as 1-120 or 1-120x5",
                           text));
    if (frames.last < frames.first || frames.step < 1 || frames.last > kMaxFrame)
        refuse(fmt::format("--frames: '{}' must go upwards, by a step of 1 or more, to {} at most", text,
                           kMaxFrame));
    return frames;
}

double parse_duration(std::string_view text) {
    const std::string complaint =
        fmt::format("--time-limit: '{}' is not a time such as 90s, 2m or 1h30m", text);
    double seconds = 0.0;
    std::string_view rest = text;
    do {
        const auto number = leading_number(rest);
        if (!number) refuse(complaint);
        rest = number->second;
        const bool is_plain = rest.empty() && number->first >= 0.0 && seconds == 0.0;
        const double unit = is_plain ? 1.0 : rest.empty() ? 0.0 : seconds_in(rest.front());
        if (unit == 0.0) refuse(complaint);
        seconds += number->first * unit;
        rest.remove_prefix(rest.empty() ? 0 : 1);
    } while (!rest.empty());
    return seconds;
}

double parse_error_target(std::string_view text) {
    const auto number = leading_number(text);
    const bool is_percent = number && number->second == "%";
    if (!number || number->first <= 0.0 || !(is_percent || number->second.empty()))
        refuse(fmt::format("--error: '{}' is not a share above 0, such as 1% or 0.01", text));
    return is_percent ? number->first / 100.0 : number->first;
}

Shard parse_shard(std::string_view text) {
    const char* const end = text.data() + text.size();
    std::uint32_t number = 0;
    std::uint32_t count = 0;
    const auto first = std::from_chars(text.data(), end, number);
    const bool has_slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
    const auto second = has_slash ? std::from_chars(first.ptr + 1, end, count) : first;
    const bool is_read = has_slash && second.ec == std::errc() && second.ptr == end;
    if (!is_read || number < 1 || number > count || count > kMaxPartSamples)
        refuse(fmt::format("--shard: '{}' is not I/N with I from 1 to N, such as 2/4, and N up to {}", text,
                           kMaxPartSamples));
    return {number - 1, count};
}

SampleSet parse_samples(std::string_view text) {
    const std::optional<SampleSet> samples = SampleSet::parse(text);
    if (!samples || samples->end() > kMaxPartSamples)
        refuse(
            fmt::format("--samples: '{}' is not a list of different samples from 0 to {}, such as 0-7,16-31",
                        text, kMaxPartSamples - 1));
    return *samples;
}

AoMethod parse_ao_method(std::string_view name) {
    static constexpr Names<AoMethod, 3> kNames = {
        {{"auto", AoMethod::automatic}, {"brute", AoMethod::brute}, {"hash", AoMethod::hash}}};
    return parse_name("--ao", name, kNames);
}

Sequence parse_sequence(std::string_view name) {
    static constexpr Names<Sequence, 3> kNames = {{{name_of(Sequence::sobol), Sequence::sobol},
                                                   {name_of(Sequence::halton), Sequence::halton},
                                                   {name_of(Sequence::white), Sequence::white}}};
    return parse_name("--sequence", name, kNames);
}

View parse_view(std::string_view name) {
    static constexpr Names<View, 8> kNames = {{{"three-quarter", View::three_quarter},
                                               {"front", View::front},
                                               {"back", View::back},
                                               {"left", View::left},
                                               {"right", View::right},
                                               {"top", View::top},
                                               {"bottom", View::bottom},
                                               {"iso", View::iso}}};
    return parse_name("--camera", name, kNames);
}

Camera parse_viewpoint(std::string_view text) {
    std::array<double, 6> values{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto [rest, error] = std::from_chars(at, end, values[i]);
        const bool is_last = i + 1 == values.size();
        const bool goes_on = is_last ? rest == end : rest != end && *rest == ',';
        if (error != std::errc() || !std::isfinite(values[i]) || !goes_on)
            refuse(fmt::format("--viewpoint: '{}' is not x,y,z,yaw,pitch,fov", text));
        at = rest + 1;
    }
    const Camera camera{{values[0], values[1], values[2]}, values[3], values[4], values[5]};
    if (!(glm::length(camera.position) <= kMaxCoordinate)) refuse("--viewpoint: lies beyond 2^30 voxels");
    if (!(std::abs(camera.pitch_deg) <= 90.0)) refuse("--viewpoint: the pitch is from -90 to 90 degrees");
    if (!(camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0))
        refuse("--viewpoint: the field of view is between 0 and 180 degrees");
    return camera;
}

CameraChoice parse_camera(std::string_view name) {
    const bool is_number = !name.empty() && name.find_first_not_of("0123456789") == name.npos;
    if (is_number) return {.side = {}, .name = std::string(name)};
    return {parse_view(name), std::string(name)};
}

Background parse_background(std::string_view text) {
    if (text == "sky") return {};
    std::uint32_t rrggbb = 0;
    const bool has_digits = text.size() == 7 && text[0] == '#';
    const char* const end = text.data() + text.size();
    if (!has_digits || std::from_chars(text.data() + 1, end, rrggbb, 16).ptr != end)
        refuse(fmt::format("--background: '{}' is no colour; an example is #20a0ff, or sky", text));
    return {Backdrop::color, linear_from_srgb_hex(rrggbb)};
}

Projection parse_projection(std::string_view name) {
    return parse_name("--projection", name, in_order<Projection>(kProjectionNames));
}

Turned parse_turned(std::string_view name) {
    return parse_name("--turn", name, in_order<Turned>(kTurnedNames));
}

EffectSwitch parse_effect_switch(std::string_view text) {
    static constexpr Names<Switch, 3> kNames = {
        {{"on", Switch::on}, {"off", Switch::off}, {"auto", Switch::automatic}}};
    const std::size_t equals = text.find('=');
    const Effect effect = effect_named(text.substr(0, equals));
    const std::string_view choice = equals == std::string_view::npos ? "" : text.substr(equals + 1);
    if (const std::optional<Switch> value = value_named(choice, kNames)) return {effect, *value};
    refuse(fmt::format("--effect: '{}' must be NAME=on, NAME=off or NAME=auto", text));
}

bool parse_denoise(std::string_view choice) {
    static constexpr Names<bool, 2> kNames = {{{"on", true}, {"off", false}}};
    return parse_word("--denoise", choice, kNames, "on or off");
}

ToneMap parse_tone(std::string_view name) {
    static constexpr Names<ToneMap, 2> kNames = {{{"filmic", ToneMap::filmic}, {"plain", ToneMap::plain}}};
    return parse_word("--tone", name, kNames, "filmic or plain");
}

ProgressMode parse_progress(std::string_view name) {
    static constexpr Names<ProgressMode, 3> kNames = {
        {{"auto", ProgressMode::automatic}, {"never", ProgressMode::never}, {"json", ProgressMode::json}}};
    return parse_word("--progress", name, kNames, "auto, never or json");
}

std::optional<float> parse_exposure(std::string_view text) {
    if (text == "auto") return {};
    float stops = 0.0f;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, stops);
    if (error == std::errc() && rest == end && std::isfinite(stops)) return stops;
    refuse(fmt::format("--exposure: {} is not a number of stops, nor auto", text));
}

std::int64_t checked_range(std::string_view flag, std::int64_t value, std::int64_t low, std::int64_t high) {
    if (value < low || value > high)
        refuse(fmt::format("{}: {} is not from {} to {}", flag, value, low, high));
    return value;
}

std::optional<double> parse_photon_radius(std::string_view text) {
    if (text == "auto") return {};
    const auto number = leading_number(text);
    const Range range = setting_of<PhotonSettings>("radius").range;
    if (number && number->second.empty() && range.holds(number->first)) return number->first;
    refuse(
        fmt::format("--radius: '{}' is neither auto nor a number of voxels in {}", text, to_string(range)));
}

}  // namespace voxilux
