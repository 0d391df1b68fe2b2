// Walks from a branch to its ancestors.
#include "journal/lineage.h"

#include <algorithm>
#include <cstdio>

#include "core/check.h"

namespace roboss {
namespace {

const BranchSpan* find(std::span<const BranchSpan> spans, BranchId id) {
    const auto found = std::ranges::find(spans, id, &BranchSpan::id);
    return found == spans.end() ? nullptr : &*found;
}

}  // namespace

Lineage Lineage::of(std::span<const BranchSpan> spans, BranchId branch) {
    const BranchSpan* span = find(spans, branch);
    ROBOSS_CHECK(span != nullptr, std::to_string(branch));
    Lineage lineage;
    lineage.parts_.push_back({span->id, span->first, std::max(span->first, span->end)});
    for (Tick until = span->first; span->first <= span->begin; until = lineage.parts_.back().from) {
        span = find(spans, span->parent);
        if (span == nullptr) break;
        if (span->first < until) lineage.parts_.push_back({span->id, span->first, until});
    }
    std::ranges::reverse(lineage.parts_);
    return lineage;
}

const Lineage::Part* Lineage::at(Tick tick) const {
    const auto above = std::ranges::upper_bound(parts_, tick, {}, &Part::from);
    return above == parts_.begin() || tick > last() ? nullptr : &*std::prev(above);
}

const Lineage::Part* Lineage::after(const Part& part) const {
    return &part == &parts_.back() ? nullptr : &part + 1;
}

std::string Lineage::text(double dt_s) const {
    std::string text;
    for (const Part& part : parts_)
        text += (text.empty() ? "branch " : ", branch ") + std::to_string(part.branch) + " to " +
                time_text(part.until, dt_s);
    return text;
}

std::string time_text(Tick tick, double dt_s) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g s", static_cast<double>(tick) * dt_s);
    return text;
}

}  // namespace roboss
