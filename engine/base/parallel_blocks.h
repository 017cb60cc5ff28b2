#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace voxilux {

// `wanted` threads; for 0 as many as the machine has.
[[nodiscard]] inline unsigned thread_count(unsigned wanted) {
    return wanted != 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

// As many threads as the machine has, but no more than there are `share`s in the work.
[[nodiscard]] inline unsigned threads_for(std::size_t work, std::size_t share) {
    return static_cast<unsigned>(std::min<std::size_t>(work / share + 1, thread_count(0)));
}

// Runs work(i) for i in [0, count) on some threads, which each take work from make_worker(). The first
// exception ends the others and is thrown again.
template <class MakeWorker>
void for_each_block(std::size_t count, unsigned threads, const MakeWorker& make_worker) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failing;
    const auto run = [&] {
        try {
            auto work = make_worker();
            for (std::size_t i = next++; i < count; i = next++)
                work(i);
        } catch (...) {
            const std::scoped_lock lock(failing);
            if (!failure) failure = std::current_exception();
            next = count;
        }
    };
    std::vector<std::jthread> others;
    try {
        for (std::size_t i = 1; i < std::min<std::size_t>(threads, count); ++i)
            others.emplace_back(run);
    } catch (const std::system_error&) {  // no more threads are to be had: those that are there do the work
    }
    run();
    others.clear();
    if (failure) std::rethrow_exception(failure);
}

// Runs work(first, end) for parts of [0, count) of so many on as many threads as the machine has.
template <class Work>
void for_each_part(std::size_t count, std::size_t part, const Work& work) {
    for_each_block((count + part - 1) / part, thread_count(0),
                   [&] { return [&](std::size_t i) { work(i * part, std::min(count, (i + 1) * part)); }; });
}

}  // namespace voxilux
