#include "flags.h"

#include <CLI/CLI.hpp>
#include <cstdint>

namespace voxilux {

Flag& Flag::required() {
    option_.required();
    return *this;
}

Flag& Flag::excludes(const std::string& other) {
    option_.excludes(other);
    return *this;
}

Flag& Flag::from_zero() {
    option_.check([](const std::string& text) { return text.starts_with("-") ? "is not 0 or above" : ""; });
    return *this;
}

Flag& Flag::shows(const std::string& value) {
    option_.default_str(value);
    return *this;
}

Flag Flag::split_at_commas() {
    option_.delimiter(',');
    return *this;
}

template <class T>
Flag Flags::on(const std::string& name, const std::string& value, std::function<void(const T&)> take,
               const std::string& help) {
    CLI::Option* const option = app_.add_option_function<T>(name, std::move(take), help)->type_name(value);
    if (!group_.empty()) option->group(group_);
    constexpr bool kIsList = requires {
        typename T::value_type;
    }
    &&!std::is_same_v<T, std::string>;
    if (kIsList) option->take_all();
    if (kIsList && name.starts_with("-")) option->allow_extra_args(false);
    return Flag(*option);
}

using Text = std::string;
template <class T>
using Take = std::function<void(const T&)>;
template Flag Flags::on<Text>(const Text&, const Text&, Take<Text>, const Text&);
template Flag Flags::on<int>(const Text&, const Text&, Take<int>, const Text&);
template Flag Flags::on<std::uint32_t>(const Text&, const Text&, Take<std::uint32_t>, const Text&);
template Flag Flags::on<std::int64_t>(const Text&, const Text&, Take<std::int64_t>, const Text&);
template Flag Flags::on<std::uint64_t>(const Text&, const Text&, Take<std::uint64_t>, const Text&);
template Flag Flags::on<float>(const Text&, const Text&, Take<float>, const Text&);
template Flag Flags::on<double>(const Text&, const Text&, Take<double>, const Text&);
template Flag Flags::on<std::vector<Text>>(const Text&, const Text&, Take<std::vector<Text>>, const Text&);
template Flag Flags::on<std::vector<int>>(const Text&, const Text&, Take<std::vector<int>>, const Text&);

std::function<Flags::GivenWords()> Flags::given() const {
    return [options = app_.get_options()] {
        GivenWords words;
        for (const CLI::Option* option : options) {
            const std::string name = option->get_name();
            if (!name.starts_with("-")) continue;
            if (option->get_expected_max() == 0) {  // its results are "true"
                if (option->count() > 0) words.emplace_back(name, "");
                continue;
            }
            for (const std::string& value : option->reduced_results())
                words.emplace_back(name, value);
        }
        return words;
    };
}

Flag Flags::on_switch(const std::string& name, std::function<void()> take, const std::string& help) {
    CLI::Option* const option = app_.add_flag_callback(name, std::move(take), help);
    if (!group_.empty()) option->group(group_);
    return Flag(*option);
}

void Flags::add_switch(const std::string& name, bool& target, const std::string& help) {
    CLI::Option* const option = app_.add_flag(name, target, help);
    if (!group_.empty()) option->group(group_);
}

}  // namespace voxilux
