#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace voxilux {

// In OBJ, MTL and .xyz files a # begins a comment, and a backslash at the end of a line continues it on the
// next; plain text has neither.
enum class LineRules : std::uint8_t { obj, plain };

// The words of a text, line by line, without comments. A byte order mark at the start is skipped.
class ObjLines {
  public:
    explicit ObjLines(std::string_view text, LineRules rules = LineRules::obj);
    ObjLines(const ObjLines&) = delete;  // line_ may view joined_
    ObjLines& operator=(const ObjLines&) = delete;

    // Goes to the next line that contains a word; false at the end of the text.
    bool next_line();

    // The next word of the line, empty at its end.
    std::string_view next_word();
    [[nodiscard]] std::string_view peek_word() const;

    // The rest of the line, without surrounding blanks.
    [[nodiscard]] std::string_view rest() const;

    // The next word as a number, which may be inf or nan; a number that is too large becomes inf. Throws
    // MeshFault for any other word; nothing at the end of the line.
    std::optional<double> next_number();
    double require_number();

    [[noreturn]] void refuse(const std::string& reason) const;  // throws MeshFault with the line's number

  private:
    std::string_view text_;
    LineRules rules_;
    std::string_view line_;
    std::string joined_;
    std::size_t at_ = 0;
    std::uint64_t number_ = 0;
};

// The number that the whole `word` is; nothing if it is not a number.
[[nodiscard]] std::optional<double> number_in(std::string_view word);

}  // namespace voxilux
