#pragma once

#include <fmt/format.h>
#include <bit>
#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "base/fnv.h"
#include "formats/image.h"

namespace voxilux {

// The checksum of the sums, positions and depths of an image, whose rows arrive one after the other, and of a
// text.
class PartChecksum {
  public:
    void add(const Image& rows) {
        for (const auto& [name, words] : rows.words)
            add_plane(name, std::span(words));
        for (const char* name : {"P.X", "P.Y", "P.Z", "Z"}) {
            const auto plane = rows.channels.find(name);
            if (plane != rows.channels.end()) add_plane(name, std::span(plane->second.pixels));
        }
    }

    [[nodiscard]] std::string text(const std::string& with) const {
        std::uint64_t hash = hash_of_text(kFnvStart, with);
        for (const auto& [name, plane] : planes_)
            hash = fnv1a(hash_of_text(hash, name), plane);
        return fmt::format("{:016x}", hash);
    }

  private:
    template <class Unit>
    void add_plane(const std::string& name, std::span<const Unit> units) {
        std::uint64_t& hash = planes_.emplace(name, kFnvStart).first->second;
        for (const Unit unit : units)
            hash = fnv1a(hash, std::bit_cast<std::uint32_t>(unit));
    }

    static std::uint64_t hash_of_text(std::uint64_t hash, const std::string& text) {
        for (const char c : text)
            hash = fnv1a(hash, static_cast<unsigned char>(c));
        return fnv1a(hash, text.size());
    }

    std::map<std::string, std::uint64_t> planes_;
};

}  // namespace voxilux
