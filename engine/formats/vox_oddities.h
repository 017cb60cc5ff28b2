#pragma once

#include "formats/vox_chunks.h"

namespace voxilux {

// Counts what is odd about the models of a file that has been read, by several threads, and puts warnings of
// it among the others, as if each model had been looked at when it was read.
void note_oddities(VoxReading& reading);

}  // namespace voxilux
