#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "jobs/picture_files.h"

namespace voxilux {

// The checkpoint of a render: a part of it (jobs/film_part.h) beside its first EXR, which is removed when the
// picture is finished.
struct Checkpoint {
    PictureFiles pictures;
    std::filesystem::path file;  // empty: the render has none
    double every_s = 0.0;        // 0: none is written
    std::function<void(const std::string&line)> note, warn;
};

// Where the checkpoint of these pictures lies, "a.exr.part"; empty without an EXR.
[[nodiscard]] std::filesystem::path checkpoint_file(const PictureFiles& pictures);

// Lets a render save the checkpoint, find out how long its end takes and, if `resumes`, go on from it.
// `checkpoint` outlives the options.
void use_checkpoint(const Checkpoint& checkpoint, bool resumes, RenderOptions& options);

// Leaves a checkpoint of a render that stopped before its end.
void leave_checkpoint(const Checkpoint& checkpoint, const Scene& scene, const RenderOutcome& outcome);

// Removes that of a render that is finished, and whose picture is written.
void remove_checkpoint(const Checkpoint& checkpoint, const RenderOutcome& outcome);

// Does to a strip of a picture what a render that its time limit stops does to the picture and its
// checkpoint, in the system's folder for temporary files, and leaves nothing: how long that takes is what is
// asked. What goes wrong is ignored.
void rehearse_output(const Checkpoint& checkpoint, const Scene& scene, RenderOutcome strip);

}  // namespace voxilux
