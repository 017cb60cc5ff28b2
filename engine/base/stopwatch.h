#pragma once

#include <ctime>

namespace voxilux {

struct Seconds {
    double cpu = 0.0;  // of all threads of the process together
    double wall = 0.0;
};

// Time since its construction. On a busy machine only CPU times can be compared.
class Stopwatch {
  public:
    [[nodiscard]] Seconds elapsed() const {
        return {seconds_on(CLOCK_PROCESS_CPUTIME_ID) - start_.cpu, seconds_on(CLOCK_MONOTONIC) - start_.wall};
    }

  private:
    static double seconds_on(clockid_t clock) {
        timespec now{};
        clock_gettime(clock, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }

    Seconds start_{seconds_on(CLOCK_PROCESS_CPUTIME_ID), seconds_on(CLOCK_MONOTONIC)};
};

}  // namespace voxilux
