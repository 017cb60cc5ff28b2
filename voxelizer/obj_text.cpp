#include "voxelizer/obj_text.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "base/printable.h"
#include "voxelizer/load_mesh.h"

namespace voxilux {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // of UTF-8

std::string_view without_blanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

}  // namespace

ObjLines::ObjLines(std::string_view text, LineRules rules)
    : text_(text.substr(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0)), rules_(rules) {}

bool ObjLines::next_line() {
    while (at_ < text_.size()) {
        joined_.clear();
        bool is_joined = true;
        while (is_joined && at_ < text_.size()) {
            const std::size_t end = std::min(text_.find('\n', at_), text_.size());
            line_ = without_blanks(text_.substr(at_, end - at_));
            at_ = end + 1;
            ++number_;
            is_joined = rules_ == LineRules::obj && line_.ends_with('\\');
            if (is_joined) joined_.append(line_.substr(0, line_.size() - 1)).push_back(' ');
        }
        if (!joined_.empty()) line_ = joined_.append(is_joined ? std::string_view() : line_);
        if (rules_ == LineRules::obj) line_ = without_blanks(line_.substr(0, line_.find('#')));
        if (!line_.empty()) return true;
    }
    return false;
}

std::string_view ObjLines::next_word() {
    const std::string_view word = peek_word();
    line_ = without_blanks(line_.substr(word.size()));
    return word;
}

std::string_view ObjLines::peek_word() const {
    return line_.substr(0, line_.find_first_of(kBlank));
}

std::string_view ObjLines::rest() const {
    return line_;
}

std::optional<double> ObjLines::next_number() {
    const std::string_view word = next_word();
    if (word.empty()) return std::nullopt;
    const auto number = number_in(word);
    if (!number) refuse(fmt::format("{} is not a number", quoted_name(word)));
    return number;
}

double ObjLines::require_number() {
    const auto number = next_number();
    if (!number) refuse("a number is missing");
    return *number;
}

void ObjLines::refuse(const std::string& reason) const {
    throw MeshFault(fmt::format("line {}: {}", number_, reason));
}

std::optional<double> number_in(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
    if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
    return value;
}

}  // namespace voxilux
