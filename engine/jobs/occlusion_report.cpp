#include "jobs/occlusion_report.h"

#include <optional>

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t count_of(const std::map<std::string, std::uint64_t>& table, const char* name) {
    const auto found = table.find(name);
    return found == table.end() ? 0 : found->second;
}

// How well the table of occlusion cells worked.
struct TableUse {
    double load = 0.0;                      // fraction of the slots in use
    std::optional<double> searched_probes;  // keys compared per search; nothing without searches
    std::optional<double> reused_share;     // fraction of hits that needed no search
};

TableUse table_use(const RenderPlan& plan, const RenderStatistics& statistics) {
    const auto number = [&](const char* name) {
        return static_cast<double>(count_of(statistics.work, name));
    };
    const double searches = number("ao_searches");
    const double located = searches + number("ao_reused");
    TableUse use{.load = static_cast<double>(statistics.live_cells) / plan.ao.slots};
    if (searches > 0.0) use.searched_probes = number("ao_probes") / searches;
    if (located > 0.0) use.reused_share = number("ao_reused") / located;
    return use;
}

Json number_or_null(const std::optional<double>& number) {
    return number ? Json(*number) : Json(nullptr);
}

std::string_view ao_method(const RenderPlan& plan) {
    return plan.ao.uses_cells() ? "hash" : "brute";
}

}  // namespace

Json planned_occlusion_json(const RenderPlan& plan) {
    if (!plan.has(Effect::ao)) return nullptr;
    Json json = {{"method", ao_method(plan)}, {"reason", plan.ao.reason}, {"slots", nullptr}};
    if (plan.ao.uses_cells()) json["slots"] = plan.ao.slots;
    return json;
}

Json occlusion_json(const RenderPlan& plan, const RenderStatistics& statistics) {
    Json json = planned_occlusion_json(plan);
    if (json.is_null()) return json;
    for (const char* number : {"live_cells", "load", "probes_per_search", "reused_share"})
        json[number] = nullptr;
    if (!plan.ao.uses_cells()) return json;
    const TableUse use = table_use(plan, statistics);
    json["live_cells"] = statistics.live_cells;
    json["load"] = use.load;
    json["probes_per_search"] = number_or_null(use.searched_probes);
    json["reused_share"] = number_or_null(use.reused_share);
    return json;
}

std::string occlusion_text(const RenderPlan& plan, const RenderStatistics& statistics) {
    if (!plan.ao.uses_cells()) return {};
    const TableUse use = table_use(plan, statistics);
    return fmt::format(
        "occlusion {} cells in {} slots, {:.3g} probes per search, {:.1f} % of hits without one\n",
        statistics.live_cells, plan.ao.slots, use.searched_probes.value_or(0.0),
        100.0 * use.reused_share.value_or(0.0));
}

}  // namespace voxilux
