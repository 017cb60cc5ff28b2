#include "write_json.h"

#include <span>

#include "base/file.h"
#include "base/json.h"
#include "base/print.h"

namespace voxilux {

void write_json(const std::string& file, const nlohmann::ordered_json& json) {
    if (file.empty()) return;
    const std::string text = json_text(json, 2) + "\n";
    if (file == "-")
        print_result("{}", text);
    else
        write_file_atomically(file, std::as_bytes(std::span(text)));
}

}  // namespace voxilux
