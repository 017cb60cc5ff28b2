#include "tradeoff/page_maker.h"

#include <string>

#include "base/error.h"
#include "base/file.h"
#include "python.h"

namespace voxilux {

namespace fs = std::filesystem;

void make_page(const fs::path& json, const fs::path& page) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ExitCode::cannot_write,
                    fmt::format("{}: cannot write: {} (--no-page makes none; all other files are there)",
                                page.string(), why));
    };
    const std::string python = python_with({"matplotlib"});
    if (python.empty()) refuse("there is no python3 with matplotlib: apt-get install python3-matplotlib");
    write_file_atomically(page, [&](const fs::path& temporary) {
        const int code =
            run_program({python, "-I", "-", json.string(), temporary.string()}, page_source(), false);
        if (code != 0) refuse(fmt::format("the page maker ended with code {}", code));
    });
}

}  // namespace voxilux
