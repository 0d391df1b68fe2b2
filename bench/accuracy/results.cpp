// Look-ups over the results, and their JSON.
#include "accuracy/results.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace roboss::bench {

const Result* find(const Results& all, std::size_t which, const std::string& engine, bool coarse) {
    for (const Result& r : all.results)
        if (r.which == which && r.engine == engine && r.coarse == coarse) return &r;
    return nullptr;
}

bool all_ours_pass(const Results& all) {
    for (const Result& r : all.results) {
        if (r.coarse || r.engine != kOurs) continue;
        const std::vector<Quantity>& quantities = all.cases[r.which].quantities;
        if (!r.outcome.possible) return false;
        for (std::size_t i = 0; i < quantities.size(); ++i)
            if (!passes(quantities[i], r.outcome.figures[i])) return false;
    }
    return true;
}

std::string to_json(const Results& all) {
    using Json = nlohmann::ordered_json;
    Json rows = Json::array();
    for (const Result& r : all.results) {
        const Case& c = all.cases[r.which];
        for (std::size_t i = 0; i < c.quantities.size(); ++i) {
            const Quantity& q = c.quantities[i];
            const double figure = r.outcome.figures[i];
            Json row{{"case", c.name},     {"quantity", q.name}, {"unit", q.unit},
                     {"engine", r.engine}, {"dt_s", r.dt_s},     {"possible", r.outcome.possible}};
            row["figure"] = std::isfinite(figure) ? Json(figure) : Json();
            row["bound"] = q.bound ? Json(*q.bound) : Json();
            row["target"] = q.target ? Json(*q.target) : Json();
            row["pass"] = q.bound && r.outcome.possible ? Json(passes(q, figure)) : Json();
            row["remark"] = r.outcome.remark;
            row["wall_s"] = r.wall_s;
            rows.push_back(std::move(row));
        }
    }
    const Json root{
        {"commit", all.commit}, {"compiler", all.compiler}, {"cpu", all.processor}, {"rows", rows}};
    return root.dump(1) + "\n";
}

}  // namespace roboss::bench
