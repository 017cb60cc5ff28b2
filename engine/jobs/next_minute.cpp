#include "jobs/next_minute.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

// An effect's part in the change of the error: noise falls by one factor, and each effect's part with it.
Json share_json(const NextMinute& minute, const NoiseShare& share) {
    Json row = {{"name", name_of(share.effect)}, {"noise_share", nullptr}, {"change", nullptr}};
    if (share.share) {
        row["noise_share"] = *share.share;
        row["change"] = *share.share * (minute.error_then - minute.error_now);
    } else {
        row["reason"] = share.reason;
    }
    return row;
}

std::string percent(double error) {
    return fmt::format("{:.2g} %", 100.0 * error);
}

}  // namespace

NextMinute price_next_minute(const ErrorCurve& curve, double samples, double seconds_per_sample,
                             std::vector<NoiseShare> shares) {
    NextMinute minute{.seconds_per_sample = seconds_per_sample,
                      .samples = kMinute_s / seconds_per_sample,
                      .shares = std::move(shares)};
    minute.error_now = expected_error(curve, samples);
    minute.error_then = expected_error(curve, samples + minute.samples);
    if (curve.law.has_bias) {
        minute.bias_now = expected_bias(curve, samples);
        minute.bias_then = expected_bias(curve, samples + minute.samples);
    }
    return minute;
}

Json next_minute_json(const std::optional<NextMinute>& minute) {
    if (!minute) return nullptr;
    Json json = {{"seconds", kMinute_s},
                 {"samples", minute->samples},
                 {"error",
                  {{"now", minute->error_now},
                   {"then", minute->error_then},
                   {"change", minute->error_then - minute->error_now}}}};
    json["bias"] = nullptr;
    if (minute->bias_now)
        json["bias"] = {{"now", *minute->bias_now},
                        {"then", *minute->bias_then},
                        {"change", *minute->bias_then - *minute->bias_now}};
    json["effects"] = Json::array();
    for (const NoiseShare& share : minute->shares)
        json["effects"].push_back(share_json(*minute, share));
    return json;
}

std::string next_minute_text(const std::optional<NextMinute>& minute) {
    if (!minute) return {};
    std::string text =
        fmt::format("one more minute buys {} samples: error {} -> {}", std::llround(minute->samples),
                    percent(minute->error_now), percent(minute->error_then));
    std::vector<NoiseShare> known;
    std::ranges::copy_if(minute->shares, std::back_inserter(known),
                         [](const NoiseShare& share) { return share.share.has_value(); });
    std::ranges::sort(known, std::greater(), [](const NoiseShare& share) { return *share.share; });
    const char* sign = "; noise by ";
    for (const NoiseShare& share : known)
        text += fmt::format("{}{} {:.0f} %", std::exchange(sign, ", "), name_of(share.effect),
                            100.0 * *share.share);
    return text;
}

}  // namespace voxilux
