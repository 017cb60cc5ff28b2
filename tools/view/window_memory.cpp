#include "view/window_memory.h"

#include <algorithm>
#include <span>

#include "base/error.h"
#include "base/file.h"
#include "base/json.h"
#include "base/print.h"
#include "base/user_folders.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxRecent = 10;
constexpr std::size_t kMaxMemoryBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxSiblings = 100;
constexpr int kMinSide = 64;  // pixels: no window comes back smaller, or larger than any monitor
constexpr int kMaxSide = 16384;

WindowMemory memory_of(const nlohmann::json& json) {
    WindowMemory memory;
    memory.size = {json.at("size").at(0).get<int>(), json.at("size").at(1).get<int>()};
    if (memory.size != glm::ivec2(0)) memory.size = glm::clamp(memory.size, kMinSide, kMaxSide);
    memory.frame_ms = std::clamp(json.at("frame_ms").get<double>(), 1.0, 10000.0);
    memory.recent = json.at("recent").get<std::vector<std::string>>();
    if (memory.recent.size() > kMaxRecent) memory.recent.resize(kMaxRecent);
    return memory;
}

bool is_scene(const std::filesystem::path& file) {
    return has_ending(file, ".vox") || has_ending(file, ".toml");
}

}  // namespace

std::filesystem::path window_memory_file() {
    const std::filesystem::path folder = state_folder();
    return folder.empty() ? folder : folder / "window.json";
}

WindowMemory read_memory(const std::filesystem::path& file) {
    std::error_code ignored;
    if (file.empty() || !std::filesystem::exists(file, ignored)) return {};
    try {
        const std::vector<std::byte> bytes = read_file(file, kMaxMemoryBytes);
        const auto json =
            parse_json<nlohmann::json>({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        if (!json) throw Error(ExitCode::input_refused, file.string() + " is no JSON");
        return memory_of(*json);
    } catch (const nlohmann::json::exception&) {
        print_message("voxilux: {} is damaged; the window begins anew\n", file.string());
    } catch (const Error& error) {
        print_message("voxilux: {}; the window begins anew\n", error.what());
    }
    return {};
}

void write_memory(const std::filesystem::path& file, const WindowMemory& memory) {
    if (file.empty()) return;
    const nlohmann::ordered_json json{
        {"size", {memory.size.x, memory.size.y}}, {"frame_ms", memory.frame_ms}, {"recent", memory.recent}};
    const std::string text = json_text(json, 2) + "\n";
    try {
        std::error_code ignored;  // write_file_atomically says what is wrong
        if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
        write_file_atomically(file, std::as_bytes(std::span(text)));
    } catch (const Error& error) {
        print_message("voxilux: {}\n", error.what());
    }
}

void add_recent(const std::filesystem::path& input, WindowMemory& memory) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::absolute(input, error);
    const std::string name = (error ? input : whole.lexically_normal()).string();
    std::erase(memory.recent, name);
    memory.recent.insert(memory.recent.begin(), name);
    if (memory.recent.size() > kMaxRecent) memory.recent.resize(kMaxRecent);
}

std::vector<std::string> files_to_open(const WindowMemory& memory) {
    if (memory.recent.empty()) return {};
    std::vector<std::string> files(memory.recent.begin() + 1, memory.recent.end());
    std::vector<std::string> siblings;
    std::error_code error;  // of a folder that is gone or cannot be read: the list ends
    const std::filesystem::path folder = std::filesystem::path(memory.recent.front()).parent_path();
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().string();
        if (is_scene(entry->path()) && std::ranges::find(memory.recent, name) == memory.recent.end())
            siblings.push_back(name);
    }
    std::ranges::sort(siblings);
    if (siblings.size() > kMaxSiblings) siblings.resize(kMaxSiblings);
    files.insert(files.end(), siblings.begin(), siblings.end());
    return files;
}

}  // namespace voxilux
