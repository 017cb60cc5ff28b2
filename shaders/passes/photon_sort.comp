#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Sorts each stored photon into its bucket.

#include "lib/address.glsl"

#include "lib/invocation.glsl"

#include "lib/photon_frame.glsl"
#include "lib/photon_words.glsl"
#include "shared/photon_cell.h"

layout(scalar) readonly buffer PhotonHeads {
    PhotonHead head;
};
layout(scalar) readonly buffer StoredPhotons {
    uint64_t stored_words[];
};
layout(scalar) readonly buffer BucketStarts {
    uint bucket_starts[];
};
layout(scalar) writeonly buffer SortedPhotons {
    uint64_t sorted_words[];
};

void main() {
    init_photons();
    uint i = linear_id();
    if (i >= min(head.count, photon.capacity)) return;
    uvec2 bucket_rank = unpack32(stored_words[kStoredWords * i + kSortedWords]);
    if (bucket_rank.x == kNoBucket) return;
    uint place = bucket_starts[bucket_rank.x] + bucket_rank.y;
    for (uint word = 0u; word < kSortedWords; ++word)
        sorted_words[kSortedWords * place + word] = stored_words[kStoredWords * i + word];
}
