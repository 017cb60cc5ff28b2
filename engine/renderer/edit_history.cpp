#include "renderer/edit_history.h"

#include <utility>

namespace voxilux {

void EditHistory::add(std::vector<BoxEdit> made, std::vector<BoxEdit> back) {
    while (entries_.size() > position_) {
        bytes_ -= bytes_of(entries_.back());
        entries_.pop_back();
    }
    back.shrink_to_fit();
    entries_.push_back({std::move(made), std::move(back)});
    bytes_ += bytes_of(entries_.back());
    while (bytes_ > max_bytes_ && !entries_.empty()) {
        bytes_ -= bytes_of(entries_.front());
        entries_.pop_front();
    }
    position_ = entries_.size();
}

const std::vector<BoxEdit>* EditHistory::undo() {
    return position_ > 0 ? &entries_[--position_].back : nullptr;
}

const std::vector<BoxEdit>* EditHistory::redo() {
    return position_ < entries_.size() ? &entries_[position_++].made : nullptr;
}

}  // namespace voxilux
