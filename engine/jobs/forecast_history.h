#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jobs/render_session.h"

namespace voxilux {

// Bytes of a history file before a new one is started: about a thousand renders. One old file is kept.
inline constexpr std::uint64_t kMaxHistoryBytes = std::uint64_t{1} << 20;

// What is kept of a render that had a forecast: {time (UTC), version, scene, scene_hash, seed, size, device,
// forecast}, the forecast with its outcome. `scene_name` is for people.
[[nodiscard]] nlohmann::ordered_json history_entry(const nlohmann::ordered_json& report,
                                                   const std::string& scene_name);

// The file that keeps the forecasts of all renders; empty when there is no home directory.
[[nodiscard]] std::filesystem::path history_file();

// Appends one line to the file and creates its folder if needed. Safe beside other processes that do the
// same: a line is one write at the end of the file. False when that fails, which harms nothing.
bool append_history(const std::filesystem::path& file, const nlohmann::ordered_json& entry);

// Stores the forecast of a render's report, if it has one.
void remember_forecast(const nlohmann::ordered_json& report, const std::string& scene_name);

// The entries of the old file and the current one, oldest first. Lines that are no entries are left out, as
// is a file that cannot be read.
[[nodiscard]] std::vector<nlohmann::ordered_json> read_history(const std::filesystem::path& file);

// How good the forecasts were: {count, inside, share_inside, median_ratio (time over expected), renders: the
// last `rows` entries}. Interrupted renders and those that a time limit ended do not count.
[[nodiscard]] nlohmann::ordered_json judge_history(const std::vector<nlohmann::ordered_json>& entries,
                                                   std::size_t rows);

// The summary as lines for people.
[[nodiscard]] std::string describe_history(const nlohmann::ordered_json& judgement);

}  // namespace voxilux
