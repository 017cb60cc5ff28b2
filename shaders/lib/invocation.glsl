// The local size and the index of an invocation. Define VX_GROUP_2D before the include for 8x8 groups
// (images); otherwise groups are 64x1 (lists), or VX_LINEAR_GROUP x 1 where that is defined. Sizes are
// specialization constants, so that the host can choose others; their ids are 100 and up.
#ifndef VX_INVOCATION_GLSL
#define VX_INVOCATION_GLSL

#ifdef VX_GROUP_2D

layout(local_size_x = 8, local_size_y = 8, local_size_x_id = 100, local_size_y_id = 101) in;

#else

#ifndef VX_LINEAR_GROUP
#define VX_LINEAR_GROUP 64
#endif
layout(local_size_x = VX_LINEAR_GROUP, local_size_x_id = 100) in;

// Index of this invocation in a one-dimensional extent. The host folds long extents into y, so
// gl_GlobalInvocationID.x alone is not enough. The last groups go beyond the extent: compare before use.
uint linear_id() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    return group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

#endif

#endif
