#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// The index of each bucket's first photon: exclusive prefix sums of the buckets' counts, in three dispatches.
// The first sums up runs of buckets, the second turns the sums of runs into prefix sums, the third computes
// those within each run.

#include "lib/invocation.glsl"

#include "lib/constants.glsl"
#include "lib/photon_frame.glsl"

VX_SPECIALIZED(uint, level, 0u);

layout(scalar) buffer PhotonHeads {
    PhotonHead head;
};
layout(scalar) readonly buffer BucketCounts {
    uint bucket_counts[];
};
layout(scalar) buffer BucketRunSums {
    uint run_sums[];
};
layout(scalar) writeonly buffer BucketStarts {
    uint bucket_starts[];
};

shared uint part_sums[kLinearGroup];

void sum_run(uint run, uint buckets) {
    uint sum = 0u;
    for (uint i = run * kScanRun; i < min((run + 1u) * kScanRun, buckets); ++i)
        sum += bucket_counts[i];
    run_sums[run] = sum;
}

// Runs in one workgroup. Each invocation takes an equal part of the runs.
void scan_runs_of_all(uint runs, uint buckets) {
    uint lane = gl_LocalInvocationID.x;
    uint length = (runs + kLinearGroup - 1u) / kLinearGroup;
    uint end = min((lane + 1u) * length, runs);
    uint sum = 0u;
    for (uint i = lane * length; i < end; ++i)
        sum += run_sums[i];
    part_sums[lane] = sum;
    barrier();
    uint before = 0u;
    for (uint i = 0u; i < lane; ++i)
        before += part_sums[i];
    for (uint i = lane * length; i < end; ++i) {
        uint run_sum = run_sums[i];
        run_sums[i] = before;
        before += run_sum;
    }
    if (lane + 1u < kLinearGroup) return;
    bucket_starts[buckets] = before;
    uint kept = min(head.count, photon.capacity);
    uint groups = (kept + kLinearGroup - 1u) / kLinearGroup;
    head.groups_x = min(groups, kMaxGroups);
    head.groups_y = (groups + kMaxGroups - 1u) / kMaxGroups;
    head.groups_z = 1u;
}

void write_starts(uint run, uint buckets) {
    uint start = run_sums[run];
    for (uint i = run * kScanRun; i < min((run + 1u) * kScanRun, buckets); ++i) {
        bucket_starts[i] = start;
        start += bucket_counts[i];
    }
}

void main() {
    init_photons();
    uint i = linear_id();
    uint buckets = photon.grid.mask + 1u;
    uint runs = scan_runs(buckets);
    if (level == 1u) {
        if (i < kLinearGroup) scan_runs_of_all(runs, buckets);
        return;
    }
    if (i >= runs) return;
    if (level == 0u)
        sum_run(i, buckets);
    else
        write_starts(i, buckets);
}
