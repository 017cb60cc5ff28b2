#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "renderer/editable_voxels.h"

namespace voxilux {

// Edits that can be undone and redone: the newest ones, as many as fit in `max_bytes`. Older edits can no
// longer be undone.
class EditHistory {
  public:
    static constexpr std::size_t kMaxBytes = std::size_t{256} << 20;

    EditHistory() = default;
    explicit EditHistory(std::size_t max_bytes) : max_bytes_(max_bytes) {}

    // Records an edit that was made, and the edits that undo it. Undone edits can no longer be redone.
    void add(std::vector<BoxEdit> made, std::vector<BoxEdit> back);

    // What to apply to undo the last edit or to redo the next one; null where there is none. Valid until
    // add().
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
    std::size_t position_ = 0;  // the first undone entry
    std::size_t bytes_ = 0;
    std::size_t max_bytes_ = kMaxBytes;
};

}  // namespace voxilux
