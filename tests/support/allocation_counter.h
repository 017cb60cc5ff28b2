#pragma once

#include <cstddef>

// Counts the bytes that operator new has handed out, in binaries that link allocation_counter.cpp. Not thread
// safe beyond its atomics: measure on one thread.
[[nodiscard]] std::size_t allocated_bytes();

// The most bytes held at once since construction, above what was held then.
class PeakAllocation {
  public:
    PeakAllocation();
    [[nodiscard]] std::size_t bytes() const;

  private:
    std::size_t start_ = 0;
};
