// What holds for the parameters of every kind of on-board controller.
#include "onboard_kinds/onboard_spec.h"

#include <cmath>
#include <type_traits>

#include "math/pose.h"

namespace roboss {
namespace {

/// Collects the names of one type of parameter, in records too.
template <class Names>
struct NameFinder {
    std::vector<std::string>& names;

    template <class Value>
    void operator()(const Parameter&, const Value& value) const {
        if constexpr (std::is_same_v<Value, Names>) {
            names.insert(names.end(), value.begin(), value.end());
        } else if constexpr (requires { requires ParameterRecord<typename Value::value_type>; }) {
            for (const auto& record : value) record.parameters(*this, record);
        }
    }
};

struct ProblemFinder {
    std::vector<OnboardProblem>& problems;

    void expect_finite(const Parameter& parameter, double value) const {
        if (std::isnan(value) || (std::isinf(value) && !parameter.infinite))
            problems.push_back({"has a " + std::string(parameter.name) + " that is not a finite number",
                                "Write a finite <" + std::string(parameter.element) + ">."});
    }
    template <class Value>
    void operator()(const Parameter& parameter, const Value& value) const {
        if constexpr (std::is_same_v<Value, double>) {
            expect_finite(parameter, value);
        } else if constexpr (std::is_same_v<Value, Vec3>) {
            if (!is_finite(value)) expect_finite(parameter, std::nan(""));
        } else if constexpr (std::is_same_v<Value, Pose>) {
            if (!is_finite(value)) expect_finite(parameter, std::nan(""));
        } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
            for (const double x : value) expect_finite(parameter, x);
        } else if constexpr (requires { requires ParameterRecord<typename Value::value_type>; }) {
            for (const auto& record : value) record.parameters(*this, record);
        }
    }
};

}  // namespace

Channel channel_of(std::string_view written, std::string_view usual, std::vector<ChannelValue> values) {
    Channel channel;
    channel.values = std::move(values);
    if (written.empty()) {
        channel.name = usual, channel.topic = "/model/{model}/" + std::string(usual);
        return channel;
    }
    std::string_view name = written;
    while (name.starts_with('/')) name.remove_prefix(1);
    if (name.starts_with("model/")) {
        const std::size_t slash = name.find('/', 6);
        if (slash != std::string_view::npos && slash + 1 < name.size()) name.remove_prefix(slash + 1);
    }
    channel.name = name.empty() ? usual : name;
    channel.topic = (written.starts_with('/') ? "" : "/") + std::string(written);
    return channel;
}

OnboardSpec::OnboardSpec() = default;
OnboardSpec::OnboardSpec(std::string name_, OnboardParameters parameters_, SourceLocation where_)
    : name(std::move(name_)), parameters(std::move(parameters_)), where(std::move(where_)) {}
OnboardSpec::OnboardSpec(const OnboardSpec& other) = default;
OnboardSpec::OnboardSpec(OnboardSpec&& other) noexcept = default;
OnboardSpec& OnboardSpec::operator=(const OnboardSpec& other) = default;
OnboardSpec& OnboardSpec::operator=(OnboardSpec&& other) noexcept = default;
OnboardSpec::~OnboardSpec() = default;

const OnboardKind& OnboardSpec::kind() const {
    return std::visit([](const auto& p) -> const OnboardKind& { return p.kKind; }, parameters);
}

std::vector<std::string> joints_named(const OnboardParameters& parameters) {
    std::vector<std::string> names;
    visit_parameters(parameters, NameFinder<JointNames>{names});
    return names;
}

std::vector<std::string> links_named(const OnboardParameters& parameters) {
    std::vector<std::string> names;
    visit_parameters(parameters, NameFinder<LinkNames>{names});
    return names;
}

bool is_force_law(const OnboardParameters& p) {
    return std::holds_alternative<LiftDragSpec>(p) || std::holds_alternative<AdvancedLiftDragSpec>(p) ||
           std::holds_alternative<HydrodynamicsSpec>(p) || std::holds_alternative<LighterThanAirSpec>(p);
}

std::vector<Channel> channels_of(const OnboardParameters& parameters) {
    return std::visit([](const auto& p) { return p.channels(); }, parameters);
}

std::vector<std::string> channels_commanded(const OnboardParameters& parameters) {
    return std::visit(
        [](const auto& p) -> std::vector<std::string> {
            if constexpr (requires { p.commands(); }) return p.commands();
            return {};
        },
        parameters);
}

std::vector<std::string> surfaces_moved(const OnboardParameters& parameters) {
    return std::visit(
        [](const auto& p) -> std::vector<std::string> {
            if constexpr (requires { p.surfaces(); }) return p.surfaces();
            return {};
        },
        parameters);
}

std::vector<double> memory_at_start(const OnboardParameters& parameters) {
    return std::visit(
        [](const auto& p) -> std::vector<double> {
            if constexpr (requires { p.memory(); }) return p.memory();
            return {};
        },
        parameters);
}

std::vector<OnboardParameters> parts_of(const OnboardParameters& parameters) {
    return std::visit(
        [](const auto& p) -> std::vector<OnboardParameters> {
            if constexpr (requires { p.parts(); }) {
                const auto parts = p.parts();
                return {parts.begin(), parts.end()};
            } else {
                return {p};
            }
        },
        parameters);
}

bool is_of_world(const OnboardParameters& parameters) {
    return std::visit(
        [](const auto& p) {
            return requires {
                p.for_model("", "");
            };
        },
        parameters);
}

std::vector<OnboardParameters> controllers_for(const OnboardParameters& parameters, const std::string& world,
                                               const std::string& model) {
    return std::visit(
        [&](const auto& p) -> std::vector<OnboardParameters> {
            if constexpr (requires { p.for_model(world, model); }) {
                const auto specs = p.for_model(world, model);
                return {specs.begin(), specs.end()};
            } else {
                return {};
            }
        },
        parameters);
}

std::vector<OnboardProblem> problems_of(const OnboardSpec& spec) {
    std::vector<OnboardProblem> problems;
    visit_parameters(spec.parameters, ProblemFinder{problems});
    std::visit([&](const auto& parameters) { parameters.check(problems); }, spec.parameters);
    return problems;
}

}  // namespace roboss
