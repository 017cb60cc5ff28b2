#include "write_json.h"

#include <span>

#include "base/file.h"

namespace voxilux {

void write_json(const std::string& file, const nlohmann::ordered_json& json) {
    if (file.empty()) return;
    const std::string text = json.dump(2) + "\n";
    if (file == "-")
        fmt::print("{}", text);
    else
        write_file_atomically(file, std::as_bytes(std::span(text)));
}

}  // namespace voxilux
