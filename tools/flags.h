#pragma once

// How subcommands declare their flags. Only flags.cpp and command_line.cpp include the library that parses
// them, because it takes long to compile.

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace voxilux {

// A declared flag, for setting more of its properties.
class Flag {
  public:
    explicit Flag(CLI::Option& option) : option_(option) {}

    Flag& required();
    // Refuses it together with another flag of the same command, which must be declared already.
    Flag& excludes(const std::string& other);
    // Its value must not be negative.
    Flag& from_zero();
    // What --help shows as its default.
    Flag& shows(const std::string& value);
    // "a,b" are two values of a flag that takes many.
    Flag split_at_commas();

  private:
    CLI::Option& option_;
};

// The flags of one subcommand. Whatever they write to must outlive the parsing. Names are "-o,--output", or a
// word without hyphens for an argument without a flag; `value` is what --help calls the value.
class Flags {
  public:
    explicit Flags(CLI::App& app) : app_(app) {}

    // Flags from here on stand under this heading of --help.
    void begin_group(const std::string& name) { group_ = name; }

    // Calls `take` with the value: std::string, int, a 32- or 64-bit whole number, float, double, or a
    // std::vector of std::string or int from all uses of the flag. `take` throws Error(usage) to refuse it.
    template <class T>
    Flag on(const std::string& name, const std::string& value, std::function<void(const T&)> take,
            const std::string& help);

    // Stores the value in a variable of one of those types, or in a std::optional of it.
    template <class T>
    Flag add(const std::string& name, const std::string& value, T& target, const std::string& help) {
        return on<T>(
            name, value, [&target](const T& given) { target = given; }, help);
    }
    template <class T>
    Flag add(const std::string& name, const std::string& value, std::optional<T>& target,
             const std::string& help) {
        return on<T>(
            name, value, [&target](const T& given) { target = given; }, help);
    }

    // Stores what `parse` makes of the text, or of the name of the flag and the text.
    template <class T, class Parse>
    Flag add_parsed(const std::string& name, const std::string& value, T& target, Parse parse,
                    const std::string& help) {
        const auto take = [&target, parse, name](const std::string& text) {
            if constexpr (std::is_invocable_v<Parse, const std::string&, const std::string&>)
                target = parse(name, text);
            else
                target = parse(text);
        };
        return on<std::string>(name, value, take, help);
    }

    // "a,b", repeated, or both: stores what `parse` makes of the words, each value once. What `target` holds
    // before is its default.
    template <class T, class Parse>
    Flag add_list(const std::string& name, const std::string& value, std::vector<T>& target, Parse parse,
                  const std::string& help) {
        const auto take = [&target, parse](const std::vector<std::string>& words) {
            target.clear();
            for (const std::string& word : words) {
                T item = parse(word);
                if (std::ranges::find(target, item) == target.end()) target.push_back(std::move(item));
            }
        };
        return on<std::vector<std::string>>(name, value, take, help).split_at_commas();
    }

    // After parsing: the flags declared so far that were given, with their values, as arguments of another
    // command line. The value of a switch is empty. Arguments without a flag are left out.
    using GivenWords = std::vector<std::pair<std::string, std::string>>;
    [[nodiscard]] std::function<GivenWords()> given() const;

    // Calls `take` where the flag, which has no value, is given.
    Flag on_switch(const std::string& name, std::function<void()> take, const std::string& help);

    // A flag without a value.
    void add_switch(const std::string& name, bool& target, const std::string& help);

  private:
    CLI::App& app_;
    std::string group_;
};

}  // namespace voxilux
