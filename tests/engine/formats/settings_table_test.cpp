// The tables of scenes/README.md say what the rows of scene/settings.h say. VOXILUX_BLESS=1 writes them.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "scene/settings.h"

namespace voxilux {
namespace {

const std::filesystem::path kPage = std::filesystem::path(VX_SOURCE_DIR) / "scenes" / "README.md";

std::string text_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

template <class T>
std::string written(const Setting& row, const T& value) {
    if (!row.choices.empty()) return fmt::format("`{}`", row.choices[static_cast<std::size_t>(value)]);
    if constexpr (std::is_enum_v<T>)
        return "an enum needs choices";
    else
        return fmt::format("{}", value);
}
template <glm::length_t N, class T>
std::string written(const Setting&, const glm::vec<N, T>& value) {
    return fmt::format("[{}]", fmt::join(&value[0], &value[0] + N, ", "));
}
std::string written(const Setting&, const HexColour&) {
    return "-";
}
std::string written(const Setting&, const std::string& text) {
    return text.empty() ? "-" : text;
}

template <class T>
std::string written(const Setting& row, const std::optional<T>& value) {
    return value ? written(row, *value) : "-";
}

std::string allowed(const Setting& row, bool is_colour, bool is_text) {
    if (!row.choices.empty()) return fmt::format("`{}`", fmt::join(row.choices, "`, `"));
    if (is_text) return "a name";
    if (is_colour) return "`\"#rrggbb\"`";
    return row.range.low == row.range.high ? "true, false" : to_string(row.range);
}

template <class Settings>
std::string table_of(const std::string& section) {
    std::string text = fmt::format("| `{}` | default | allowed | meaning |\n|---|---|---|---|\n", section);
    Settings settings;
    visit_settings(settings, [&]<class T>(const Setting& row, T&& value) {
        constexpr bool is_colour = std::is_same_v<std::remove_cvref_t<T>, HexColour>;
        constexpr bool is_text = std::is_same_v<std::remove_cvref_t<T>, std::string>;
        text += fmt::format("| `{}` | {} | {} | {} |\n", row.name,
                            row.is_required ? "needed" : written(row, value),
                            allowed(row, is_colour, is_text), row.sentence);
    });
    return text + "\n";
}

const std::string kTables[] = {
    table_of<RenderSettings>("[render]"),
    table_of<CameraSettings>("[camera]"),
    table_of<AoSettings>("[ao]"),
    table_of<PhotonSettings>("[photons]"),
    table_of<PathSettings>("[paths]"),
    table_of<Sun>("[sun]"),
    table_of<Sky>("[sky]"),
    table_of<Background>("[background]"),
    table_of<Ground>("[ground]"),
    table_of<Material>("[material.NAME]"),
    table_of<Sphere>("[[sphere]]"),
    table_of<CameraKeySettings>("[[camera.key]]"),
    table_of<Turntable>("[camera.turntable]"),
};

// The page with the table in place of the one that has the same first line.
std::string with_table(std::string page, const std::string& table) {
    const std::size_t from = page.find(table.substr(0, table.find('\n')));
    if (from == std::string::npos) return page + "\n" + table;
    return page.replace(from, page.find("\n\n", from) + 2 - from, table);
}

TEST(SettingsTable, readme_has_the_tables_of_the_rows) {
    std::string page = text_of(kPage);
    if (std::getenv("VOXILUX_BLESS") != nullptr) {
        for (const std::string& table : kTables)
            page = with_table(page, table);
        std::ofstream(kPage) << page;
    }
    for (const std::string& table : kTables)
        EXPECT_NE(page.find(table), std::string::npos)
            << "scenes/README.md lacks this table; run this test once with VOXILUX_BLESS=1\n"
            << table;
}

TEST(SettingsTable, page_that_differs_is_found_out) {
    std::string page = with_table("# A page\n", kTables[0]);
    EXPECT_NE(page.find(kTables[0]), std::string::npos);
    page.replace(page.find("65535"), 5, "65536");
    EXPECT_EQ(page.find(kTables[0]), std::string::npos);
    EXPECT_NE(with_table(page, kTables[0]).find(kTables[0]), std::string::npos);
}

// Every default is a value that a file may have, and every row has a short sentence.
TEST(SettingsTable, rows_are_sound) {
    Scene scene;
    visit_sections(scene, [](std::string_view section, auto& settings) {
        visit_settings(settings, [&](const Setting& row, const auto& value) {
            if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>) {
                const bool is_number = row.range.low < row.range.high;
                EXPECT_TRUE(!is_number || row.range.holds(static_cast<double>(value)))
                    << section << ' ' << row.name;
            }
        });
    });
    for (const std::string& table : kTables) {
        std::istringstream lines(table);
        for (std::string line; std::getline(lines, line);)
            EXPECT_TRUE(line.size() <= 110 && !line.ends_with("|  |")) << line;
    }
}

TEST(SettingsTable, ranges_know_their_ends) {
    EXPECT_TRUE(Range({1, 3}).holds(1.0) && Range({1, 3}).holds(3.0));
    EXPECT_FALSE(above(1, 3).holds(1.0) || below(1, 3).holds(3.0) || between(1, 3).holds(1.0));
    EXPECT_EQ(to_string(between(0, 180)) + to_string(Range{0, 1e6}), "(0, 180)[0, 1000000]");
    EXPECT_EQ(setting_of<PhotonSettings>("radius").range.high, 65536.0);
}

}  // namespace
}  // namespace voxilux
