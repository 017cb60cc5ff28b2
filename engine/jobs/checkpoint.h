#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "jobs/picture_files.h"

namespace voxilux {

// The checkpoint of a render: a part of it (jobs/film_part.h) beside its first EXR, removed when the image is
// finished.
struct Checkpoint {
    PictureFiles pictures;
    std::filesystem::path file;  // empty: the render has none
    double every_s = 0.0;        // 0: no checkpoints
    std::function<void(const std::string&line)> note, warn;
};

// Where the checkpoint of these image files lies, "a.exr.part"; empty without an EXR.
[[nodiscard]] std::filesystem::path checkpoint_file(const PictureFiles& pictures);

// Lets a render save the checkpoint, measure how long its end takes and, if `resumes`, continue from it.
// `checkpoint` must outlive the options.
void use_checkpoint(const Checkpoint& checkpoint, bool resumes, RenderOptions& options);

// Saves a checkpoint of a render that stopped before its end.
void leave_checkpoint(const Checkpoint& checkpoint, const Scene& scene, const RenderOutcome& outcome);

// Removes the checkpoint of a render that is finished and whose image is written.
void remove_checkpoint(const Checkpoint& checkpoint, const RenderOutcome& outcome);

// Writes a strip of an image and its checkpoint to the system's temporary folder, as the end of a render does
// when its time limit stops it, and removes the files again: the caller measures how long that takes. Errors
// are ignored.
void rehearse_output(const Checkpoint& checkpoint, const Scene& scene, RenderOutcome strip);

}  // namespace voxilux
