#pragma once

#include <string>

namespace CLI {
class App;
}

namespace voxilux {

struct InfoOptions {
    std::string file;
    std::string
        json;  // where the JSON object goes: a file, "-" for standard output instead of text, "" for nowhere
};

// Declares the subcommand and its flags; parsing fills `options`, which must outlive the app.
CLI::App* add_info(CLI::App& app, InfoOptions& options);

// Prints what is in a .vox file, a scene file, an EXR or a PNG on standard output. Returns the exit code;
// throws Error(input_refused) when the file is refused or of a kind that we do not know.
int run_info(const InfoOptions& options);

}  // namespace voxilux
