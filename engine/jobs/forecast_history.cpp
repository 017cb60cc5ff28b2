#include "jobs/forecast_history.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>

#include "base/json.h"
#include "base/median.h"
#include "base/user_folders.h"
#include "jobs/forecast_report.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path old_file(const fs::path& file) {
    fs::path old = file;
    return old.replace_extension(".old" + file.extension().string());
}

std::string utc_time() {
    const std::time_t now = std::time(nullptr);
    std::tm fields{};
    gmtime_r(&now, &fields);
    char text[32];
    return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &fields)};
}

// A file descriptor that closes itself.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    [[nodiscard]] int number() const { return number_; }

  private:
    int number_;
};

bool is_same_file(const struct stat& a, const struct stat& b) {
    return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

// Renames a full file. Of several processes that find it full, the one that holds its lock does, and only
// while the name still refers to the full file.
void make_room(const fs::path& file, int descriptor) {
    struct stat open_one {};
    struct stat named_one {};
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return;
    if (::fstat(descriptor, &open_one) != 0 || ::stat(file.c_str(), &named_one) != 0) return;
    if (!is_same_file(open_one, named_one)) return;
    if (static_cast<std::uint64_t>(open_one.st_size) < kMaxHistoryBytes) return;
    (void)::rename(file.c_str(), old_file(file).c_str());
}

void read_lines(const fs::path& file, std::vector<Json>& entries) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::optional<Json> entry = parse_json<Json>(line);
        if (entry && entry->is_object()) entries.push_back(*std::move(entry));
    }
}

// The number at the end of a path of keys; nothing where it is missing.
std::optional<double> number_at(const Json& json, std::initializer_list<const char*> keys) {
    const Json* at = &json;
    for (const char* key : keys) {
        if (!at->is_object() || !at->contains(key)) return std::nullopt;
        at = &at->at(key);
    }
    return at->is_number() ? std::optional(at->get<double>()) : std::nullopt;
}

// What an entry tells about its forecast.
struct Judged {
    bool is_inside = false;
    double ratio = 1.0;
};

std::optional<Judged> judge(const Json& entry) {
    const std::string stopped = entry.value("stopped", "");
    if (stopped != "finished" && stopped != "error target reached") return std::nullopt;
    const auto low = number_at(entry, {"forecast", "low_s"}), high = number_at(entry, {"forecast", "high_s"});
    const auto expected = number_at(entry, {"forecast", "expected_s"});
    const auto wall = number_at(entry, {"forecast", "outcome", "wall_s"});
    if (!low || !high || !expected || !wall || !(*expected > 0.0)) return std::nullopt;
    return Judged{.is_inside = *wall >= *low && *wall <= *high, .ratio = *wall / *expected};
}

}  // namespace

Json history_entry(const Json& report, const std::string& scene_name) {
    Json entry = {{"time", utc_time()}, {"version", report.at("version")}, {"scene", scene_name}};
    for (const char* key : {"scene_hash", "seed", "size", "stopped"})
        entry[key] = report.at(key);
    entry["device"] = report.at("device").at("name");
    entry["forecast"] = report.at("forecast");
    return entry;
}

fs::path history_file() {
    const fs::path folder = state_folder();
    return folder.empty() ? folder : folder / "forecasts.jsonl";
}

bool append_history(const fs::path& file, const Json& entry) {
    if (file.empty()) return false;
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    const Descriptor out(::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666));
    if (out.number() < 0) return false;
    const std::string line = json_text(entry) + "\n";
    const bool is_written =
        ::write(out.number(), line.data(), line.size()) == static_cast<ssize_t>(line.size());
    struct stat status {};
    if (::fstat(out.number(), &status) == 0 && static_cast<std::uint64_t>(status.st_size) >= kMaxHistoryBytes)
        make_room(file, out.number());
    return is_written;
}

void remember_forecast(const Json& report, const std::string& scene_name) {
    if (report.at("forecast").at("low_s").is_null()) return;
    (void)append_history(history_file(), history_entry(report, scene_name));
}

std::vector<Json> read_history(const fs::path& file) {
    std::vector<Json> entries;
    read_lines(old_file(file), entries);
    read_lines(file, entries);
    return entries;
}

Json judge_history(const std::vector<Json>& entries, std::size_t rows) {
    std::vector<double> ratios;
    std::size_t inside = 0;
    for (const Json& entry : entries) {
        const auto judged = judge(entry);
        if (!judged) continue;
        ratios.push_back(judged->ratio);
        if (judged->is_inside) ++inside;
    }
    Json json = {{"count", ratios.size()}, {"inside", inside}, {"meant_inside", kForecastConfidence}};
    json["share_inside"] = nullptr;
    json["median_ratio"] = nullptr;
    if (!ratios.empty()) {
        json["share_inside"] = static_cast<double>(inside) / static_cast<double>(ratios.size());
        json["median_ratio"] = median(ratios);
    }
    json["renders"] = Json::array();
    for (std::size_t i = entries.size() - std::min(rows, entries.size()); i < entries.size(); ++i)
        json["renders"].push_back(entries[i]);
    return json;
}

std::string describe_history(const Json& judgement) {
    const auto count = judgement.at("count").get<std::size_t>();
    if (count == 0) return "history   no render had a forecast yet; render --error makes one\n";
    std::string text = fmt::format(
        "history   {} forecasts, {:.0f} % of the times inside (meant: {:.0f} %), time / expected {:.2f} in "
        "the "
        "middle\n",
        count, 100.0 * judgement.at("share_inside").get<double>(), 100.0 * kForecastConfidence,
        judgement.at("median_ratio").get<double>());
    for (const Json& entry : judgement.at("renders")) {
        const auto low = number_at(entry, {"forecast", "low_s"}),
                   high = number_at(entry, {"forecast", "high_s"});
        const auto wall = number_at(entry, {"forecast", "outcome", "wall_s"});
        const auto error = number_at(entry, {"forecast", "error"});
        if (!low || !high || !wall || !error) continue;
        const bool is_inside = *wall >= *low && *wall <= *high;
        text +=
            fmt::format("render    {:<20} {:<24} {:>7} {:>16}  {:>8.2f} s  {}\n", entry.value("time", "?"),
                        entry.value("scene", "?"), percent_text(*error), time_range_text(*low, *high), *wall,
                        judge(entry) ? (is_inside ? "inside" : "outside") : entry.value("stopped", "?"));
    }
    return text;
}

}  // namespace voxilux
