#ifndef VX_LOOPS_GLSL
#define VX_LOOPS_GLSL

// Lavapipe silently ends all loops of an invocation after 65535 turns in total. This tests afterwards whether
// it did: `turns` must be 2 or more, and unknown to the compiler.
bool are_loops_spent(uint turns) {
    uint done = 0u;
    while (done < turns)
        ++done;
    return done < turns;
}

#endif
