#include "tradeoff/page_maker.h"

#include <string>
#include <system_error>

#include "base/error.h"
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
    const fs::path temporary = page.string() + ".part";
    const int code =
        run_program({python, "-I", "-", json.string(), temporary.string()}, page_source(), false);
    std::error_code failure;
    if (code == 0) fs::rename(temporary, page, failure);
    if (code == 0 && !failure) return;
    std::error_code ignored;
    fs::remove(temporary, ignored);
    refuse(code == 0 ? failure.message() : fmt::format("the page maker ended with code {}", code));
}

}  // namespace voxilux
