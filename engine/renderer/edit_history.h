#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "renderer/editable_voxels.h"

namespace voxilux {

// Edits that can be taken back and made again. It holds as many as fit the memory, the newest ones; what is
// forgotten stays as it is.
class EditHistory {
  public:
    static constexpr std::size_t kMaxBytes = std::size_t{256} << 20;

    EditHistory() = default;
    explicit EditHistory(std::size_t max_bytes) : max_bytes_(max_bytes) {}

    // An edit was made, and `back` takes it back. Edits that were taken back before are forgotten.
    void add(std::vector<BoxEdit> made, std::vector<BoxEdit> back);

    // What to apply to take the last edit back, or to make the next one again; nothing where there is none.
    // Valid until add().
    [[nodiscard]] const std::vector<BoxEdit>* undo();
    [[nodiscard]] const std::vector<BoxEdit>* redo();

    [[nodiscard]] std::size_t undo_count() const { return position_; }
    [[nodiscard]] std::size_t redo_count() const { return entries_.size() - position_; }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

  private:
    struct Entry {
        std::vector<BoxEdit> made;
        std::vector<BoxEdit> back;
    };
    [[nodiscard]] static std::size_t bytes_of(const Entry& entry) {
        return sizeof(Entry) + (entry.made.size() + entry.back.size()) * sizeof(BoxEdit);
    }

    std::deque<Entry> entries_;
    std::size_t position_ = 0;  // the first entry that is taken back
    std::size_t bytes_ = 0;
    std::size_t max_bytes_ = kMaxBytes;
};

}  // namespace voxilux
