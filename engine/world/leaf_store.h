#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/checked_cast.h"
#include "world/leaf_block.h"

namespace voxilux {

// Of a value without padding.
template <class T>
[[nodiscard]] std::size_t hash_of_bytes(const T& value) {
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(&value), sizeof(value)});
}

// Appends blocks to leaves, each distinct one once.
class LeafStore {
  public:
    explicit LeafStore(std::vector<std::uint32_t>& leaves) : leaves_(leaves) {}

    // The number of the block.
    std::uint32_t add(const LeafBlock& block) {
        const auto number = checked_cast<std::uint32_t>(leaves_.size() / block.size(), "mixed bricks");
        const auto [known, is_new] = numbers_.try_emplace(block, number);
        if (is_new) leaves_.insert(leaves_.end(), block.begin(), block.end());
        return known->second;
    }

    // The numbers of all blocks of other leaves.
    std::vector<std::uint32_t> add_all(const std::vector<std::uint32_t>& leaves) {
        std::vector<std::uint32_t> numbers;
        LeafBlock block;
        for (std::size_t i = 0; i < leaves.size(); i += block.size()) {
            std::copy_n(&leaves[i], block.size(), block.begin());
            numbers.push_back(add(block));
        }
        return numbers;
    }

  private:
    struct Hash {
        std::size_t operator()(const LeafBlock& block) const { return hash_of_bytes(block); }
    };

    std::vector<std::uint32_t>& leaves_;
    std::unordered_map<LeafBlock, std::uint32_t, Hash> numbers_;
};

}  // namespace voxilux
