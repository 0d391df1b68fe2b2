// An SVG of its own, readable on light and dark pages: the energy error of the swinging arm, logarithmic,
// each curve named at its end.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "accuracy/results.h"

namespace roboss::bench {
namespace {

using Text = fmt::memory_buffer;

constexpr double kWidth = 860, kHeight = 460, kLeft = 74, kRight = 110, kTop = 70, kBottom = 50;  // px
constexpr int kLowest = -14, kHighest = 1;                                                        // decades
constexpr const char* kColours[] = {"#d1495b", "#2e86ab", "#e08e2b", "#3f9263", "#8a6bbf"};

template <class... Args>
void add(Text& text, fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points;
    double label_y = 0;
};

double x_of(double time, double time_max) {
    return kLeft + (kWidth - kLeft - kRight) * time / time_max;
}

double y_of(double value) {
    const double decade = std::clamp(std::log10(std::fmax(value, 1e-300)), 1.0 * kLowest, 1.0 * kHighest);
    return kTop + (kHeight - kTop - kBottom) * (kHighest - decade) / (kHighest - kLowest);
}

void write_axes(Text& text, double time_max) {
    for (int decade = kLowest; decade <= kHighest; decade += 2) {
        const double y = y_of(std::pow(10.0, decade));
        add(text, R"(<line class="grid" x1="{}" y1="{:.1f}" x2="{}" y2="{:.1f}"/>)", kLeft, y,
            kWidth - kRight, y);
        add(text,
            R"(<text x="{}" y="{:.1f}" text-anchor="end">10<tspan dy="-5" font-size="10">{}</tspan></text>)"
            "\n",
            kLeft - 10, y + 4, decade);
    }
    for (int t = 0; t <= static_cast<int>(time_max); t += 2)
        add(text, R"(<text x="{:.1f}" y="{}" text-anchor="middle">{} s</text>)", x_of(t, time_max),
            kHeight - kBottom + 22, t);
    add(text, "\n");
}

/// Names at the ends of the curves, pushed apart where they would overlap.
void place_labels(std::vector<Curve>& curves) {
    for (Curve& c : curves) c.label_y = y_of(c.points.back().second) + 4;
    std::vector<Curve*> order;
    for (Curve& c : curves) order.push_back(&c);
    std::sort(order.begin(), order.end(),
              [](const Curve* a, const Curve* b) { return a->label_y < b->label_y; });
    for (std::size_t i = 1; i < order.size(); ++i)
        order[i]->label_y = std::fmax(order[i]->label_y, order[i - 1]->label_y + 16);
}

std::vector<Curve> curves_of(const Results& all) {
    std::vector<Curve> curves;
    for (std::size_t which = 0; which < all.cases.size(); ++which) {
        if (all.cases[which].name != "arm") continue;
        for (const EngineNote& engine : all.engines) {
            const Result* result = find(all, which, engine.name, false);
            if (result != nullptr && !result->outcome.trace.empty())
                curves.push_back({engine.name, result->outcome.trace});
        }
    }
    return curves;
}

}  // namespace

std::string to_svg(const Results& all) {
    std::vector<Curve> curves = curves_of(all);
    if (curves.empty()) return {};
    place_labels(curves);
    const double time_max = curves.front().points.back().first;
    Text text;
    add(text,
        R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}" width="{}" height="{}">)"
        "\n",
        kWidth, kHeight, kWidth, kHeight);
    add(text, "{}",
        "<style>text{font:13px sans-serif;fill:#24292f}.grid{stroke:#24292f;stroke-opacity:.15}"
        ".back{fill:#fff}.curve{fill:none;stroke-width:2;stroke-linejoin:round}.name{font-weight:600}"
        ".title{font-size:16px;font-weight:600}@media(prefers-color-scheme:dark){text{fill:#e6edf3}"
        ".grid{stroke:#e6edf3}.back{fill:#0d1117}}</style>\n");
    add(text, R"(<rect class="back" width="{}" height="{}"/>)", kWidth, kHeight);
    add(text, R"(<text class="title" x="{}" y="26">Energy error of a freely swinging arm, dt 1 ms</text>)",
        20);
    add(text,
        R"(<text x="{}" y="45">relative to the energy of the swing; lower is better</text>)"
        "\n",
        20);
    write_axes(text, time_max);
    for (std::size_t i = curves.size(); i-- > 0;) {  // ours on top
        const Curve& c = curves[i];
        const char* colour = kColours[i % std::size(kColours)];
        add(text, R"(<polyline class="curve" stroke="{}" points=")", colour);
        for (const auto& [t, value] : c.points) add(text, "{:.1f},{:.1f} ", x_of(t, time_max), y_of(value));
        add(text,
            R"("/><text class="name" style="fill:{}" x="{}" y="{:.1f}">{}</text>)"
            "\n",
            colour, kWidth - kRight + 8, c.label_y, c.name);
    }
    add(text, "</svg>\n");
    return fmt::to_string(text);
}

}  // namespace roboss::bench
