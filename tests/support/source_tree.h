#pragma once

// The project's own source text, for tests of rules that a compiler cannot check.

#include <regex.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace voxilux::test {

struct SourceFile {
    std::string path;  // from the top folder, with '/'
    std::string text;
};

inline std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// A POSIX extended regular expression. std::regex would cost a minute of compiling under sanitizers.
class Pattern {
  public:
    explicit Pattern(const std::string& expression, int flags = 0) {
        if (::regcomp(&compiled_, expression.c_str(), REG_EXTENDED | flags) != 0)
            throw std::invalid_argument("bad pattern " + expression);
    }
    ~Pattern() { ::regfree(&compiled_); }
    Pattern(const Pattern&) = delete;
    Pattern& operator=(const Pattern&) = delete;

    // The first match in `line` and its groups; nothing when there is none.
    [[nodiscard]] std::vector<std::string> find(const std::string& line) const {
        constexpr std::size_t kMaxGroups = 4;
        ::regmatch_t found[kMaxGroups];
        std::vector<std::string> groups;
        if (::regexec(&compiled_, line.c_str(), kMaxGroups, found, 0) != 0) return groups;
        for (const ::regmatch_t& group : found) {
            const auto start = static_cast<std::size_t>(group.rm_so);
            const auto length = static_cast<std::size_t>(group.rm_eo - group.rm_so);
            groups.push_back(group.rm_so < 0 ? "" : line.substr(start, length));
        }
        return groups;
    }

  private:
    ::regex_t compiled_{};
};

// Files below a folder of the tree whose names end in one of `endings`, sorted by path.
inline std::vector<SourceFile> source_files(const std::string& folder,
                                            const std::vector<std::string>& endings) {
    namespace fs = std::filesystem;
    const fs::path top = VX_SOURCE_DIR;
    std::vector<SourceFile> files;
    if (!fs::is_directory(top / folder)) return files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(top / folder)) {
        const std::string name = entry.path().filename().string();
        const auto is_ending = [&](const std::string& ending) { return name.ends_with(ending); };
        if (entry.is_regular_file() && std::ranges::any_of(endings, is_ending))
            files.push_back({entry.path().lexically_relative(top).generic_string(), read_text(entry.path())});
    }
    std::ranges::sort(files, {}, &SourceFile::path);
    return files;
}

// All code of ours: C++, shaders and build files.
inline std::vector<SourceFile> all_code() {
    std::vector<SourceFile> files;
    for (const char* folder : {"engine", "shaders", "voxelizer", "tools", "tests", "fuzz"}) {
        std::vector<SourceFile> more =
            source_files(folder, {".h", ".cpp", ".glsl", ".comp", ".cmake", "CMakeLists.txt"});
        std::ranges::move(more, std::back_inserter(files));
    }
    files.push_back({"CMakeLists.txt", read_text(std::filesystem::path(VX_SOURCE_DIR) / "CMakeLists.txt")});
    return files;
}

inline std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

// Faults as one text, a line each; empty when there are none.
inline std::string joined(const std::vector<std::string>& faults) {
    std::string text;
    for (const std::string& fault : faults)
        text += fault + "\n";
    return text;
}

}  // namespace voxilux::test
