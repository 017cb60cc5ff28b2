#include "support/allocation_counter.h"

#include <atomic>
#include <cstdlib>
#include <new>

// Each block carries its size in front, so that the count does not depend on the C library. All unaligned
// forms are replaced together: a block of one must not meet the delete of another.
namespace {

constexpr std::size_t kFront = alignof(std::max_align_t);
static_assert(kFront >= sizeof(std::size_t));

std::atomic<std::size_t> held{0};
std::atomic<std::size_t> peak{0};

void* counted_block(std::size_t size) noexcept {
    void* block = std::malloc(size + kFront);
    if (block == nullptr) return nullptr;
    *static_cast<std::size_t*>(block) = size;
    const std::size_t now = held += size;
    if (now > peak) peak = now;
    return static_cast<char*>(block) + kFront;
}

void* counted_block_or_throw(std::size_t size) {
    void* block = counted_block(size);
    if (block == nullptr) throw std::bad_alloc();
    return block;
}

void release(void* pointer) noexcept {
    if (pointer == nullptr) return;
    void* block = static_cast<char*>(pointer) - kFront;
    held -= *static_cast<std::size_t*>(block);
    std::free(block);
}

}  // namespace

void* operator new(std::size_t size) {
    return counted_block_or_throw(size);
}
void* operator new[](std::size_t size) {
    return counted_block_or_throw(size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return counted_block(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return counted_block(size);
}
void operator delete(void* pointer) noexcept {
    release(pointer);
}
void operator delete[](void* pointer) noexcept {
    release(pointer);
}
void operator delete(void* pointer, std::size_t) noexcept {
    release(pointer);
}
void operator delete[](void* pointer, std::size_t) noexcept {
    release(pointer);
}
void operator delete(void* pointer, const std::nothrow_t&) noexcept {
    release(pointer);
}
void operator delete[](void* pointer, const std::nothrow_t&) noexcept {
    release(pointer);
}

std::size_t allocated_bytes() {
    return held;
}

PeakAllocation::PeakAllocation() : start_(held) {
    peak = start_;
}

std::size_t PeakAllocation::bytes() const {
    return peak - start_;
}
