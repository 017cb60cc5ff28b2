#include "tradeoff/page_maker.h"

#include <stdexcept>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "python.h"

namespace voxilux {

namespace fs = std::filesystem;

void make_page(const fs::path& json, const fs::path& page) {
    try {
        const std::string python = python_with({"matplotlib"});
        if (python.empty())
            throw Error(ExitCode::cannot_write,
                        fmt::format("{}: cannot write: there is no python3 with matplotlib: apt-get install "
                                    "python3-matplotlib",
                                    page.string()));
        check_writable(page);
        write_file_atomically(page, [&](const fs::path& temporary) {
            const int code =
                run_program({python, "-I", "-", json.string(), temporary.string()}, page_source(), false);
            if (code != 0) throw std::runtime_error(fmt::format("the page maker ended with code {}", code));
        });
    } catch (const Error& cause) {
        throw Error(ExitCode::cannot_write,
                    fmt::format("{} (--no-page makes none; all other files are there)", cause.what()));
    }
}

}  // namespace voxilux
