// Reads the elements of a kind's parameters (core/parameter.h) into their values.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/parameter.h"
#include "onboard_kinds/onboard_spec.h"
#include "sdf/conversion.h"

namespace roboss::sdf_import {

/// Calls found(part) for each part of "a|b|c".
template <class Found>
void for_each_part(std::string_view text, char separator, Found&& found) {
    while (!text.empty()) {
        const std::size_t end = text.find(separator);
        found(std::string(text.substr(0, end)));
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
}

/// Whether `name` is one of "a|b|c".
bool is_one_of(std::string_view names, const std::string& name);

/// Below `block`, the element that holds the last one of a path "a/b/c", and the last one's name. Of several
/// paths "a/b|c", the first that is written, or else the first.
std::pair<Element, std::string> place_of(const Element& block, const char* paths);

/// Reports the elements that a kind does not honour; `phrase`: "a laser".
void report_ignored(const Element& block, std::span<const IgnoredElement> ignored, const char* phrase,
                    const Import& import);

/// <noise type="gaussian"> or, as older files write it, <noise><type>gaussian</type>.
NoiseSpec read_noise(const Element& noise, const Import& import);

/// A visitor of parameters. What is not written keeps its value. `scope` is the prefix of the names in a
/// nested model ("inner::" or "").
struct ParameterReader {
    const Element& block;
    const std::string& scope;
    const Import& import;

    template <class Value>
    void operator()(const Parameter& p, Value& value) const {
        if constexpr (std::is_same_v<Value, LinkNames>)
            if (p.element[0] == '@') return read_attribute(p.element + 1, value);
        const auto [parent, name] = place_of(block, p.element);
        read(p, parent, name, value);
    }

  private:
    void read(const Parameter& p, const Element& parent, const std::string& name, double& value) const;
    void read(const Parameter& p, const Element& parent, const std::string& name, int& value) const;
    void read(const Parameter& p, const Element& parent, const std::string& name, bool& value) const;
    void read(const Parameter& p, const Element& parent, const std::string& name, std::string& value) const;
    void read(const Parameter& p, const Element& parent, const std::string& name, Vec3& value) const;
    void read(const Parameter& p, const Element& parent, const std::string& name, Pose& value) const;
    void read(const Parameter& p, const Element& parent, const std::string& name, NoiseSpec& value) const;
    void read(const Parameter& p, const Element& parent, const std::string& name, JointNames& value) const;
    void read(const Parameter& p, const Element& parent, const std::string& name, LinkNames& value) const;
    /// Repeated elements, or one with names between commas.
    void read(const Parameter& p, const Element& parent, const std::string& name,
              std::vector<std::string>& value) const;
    /// Repeated elements, each with one number or several.
    void read(const Parameter& p, const Element& parent, const std::string& name,
              std::vector<double>& value) const;
    /// Of `block`.
    void read_attribute(const char* name, std::vector<std::string>& names) const;
    void read_names(const Element& parent, const std::string& name, std::vector<std::string>& names) const;

    template <ParameterRecord Record>
    void read(const Parameter&, const Element& parent, const std::string& name,
              std::vector<Record>& records) const {
        if (!parent) return;
        for (const auto node : parent.node.children(name.c_str())) {
            const Element element{parent.source, node};
            Record::parameters(ParameterReader{element, scope, import}, records.emplace_back());
        }
    }
};

}  // namespace roboss::sdf_import
