// Calls libsdformat and translates its errors.
#include "sdf/libsdformat_reader.h"

#include <algorithm>

#include "sdf/console_capture.h"

namespace roboss::sdf_import {
namespace {

Element element_at(const Skeleton& skeleton, int line) {
    const auto index = static_cast<std::size_t>(line - 1);
    return line >= 1 && index < skeleton.lines.size() ? skeleton.lines[index] : Element{};
}

/// The text between the first "before[" and the next "]".
std::string bracketed(const std::string& message, const std::string& before) {
    const std::size_t start = message.find(before + "[");
    if (start == std::string::npos) return {};
    const std::size_t from = start + before.size() + 1;
    return message.substr(from, message.find(']', from) - from);
}

/// Errors of the graphs name no line, but often "joint with name[x]": finds that element under the model.
Element element_named_in(const std::string& message, const Element& model) {
    for (const char* tag : {"joint", "frame", "link", "collision", "visual", "model"}) {
        const std::string name = bracketed(message, std::string(tag) + " with name");
        if (name.empty()) continue;
        const auto node = model.node.find_node([&](pugi::xml_node n) {
            return std::string(n.name()) == tag && name == n.attribute("name").value();
        });
        if (node) return {model.source, node};
    }
    return model;
}

std::string trimmed(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    return text;
}

bool is_joint_to_nowhere(const sdf::Error& error) {
    return error.Code() == sdf::ErrorCode::JOINT_CHILD_LINK_INVALID ||
           error.Code() == sdf::ErrorCode::JOINT_PARENT_LINK_INVALID;
}

/// Follows from an error that is told already: by validate() (joints to nowhere), or one line earlier.
bool is_consequence(const sdf::Error& error, bool joint_to_nowhere, std::size_t reported) {
    switch (error.Code()) {
        case sdf::ErrorCode::JOINT_CHILD_LINK_INVALID:
        case sdf::ErrorCode::JOINT_PARENT_LINK_INVALID:
            return true;
        case sdf::ErrorCode::FRAME_ATTACHED_TO_GRAPH_ERROR:
        case sdf::ErrorCode::POSE_RELATIVE_TO_GRAPH_ERROR:
            return joint_to_nowhere || reported > 0;
        case sdf::ErrorCode::FRAME_ATTACHED_TO_INVALID:
        case sdf::ErrorCode::POSE_RELATIVE_TO_INVALID:
            return joint_to_nowhere && (error.Message().find("specified by joint") != std::string::npos ||
                                        error.Message().find("frame with name [") != std::string::npos);
        default:
            return false;
    }
}

}  // namespace

ReadModel::ReadModel(std::shared_ptr<const sdf::Root> root, Skeleton skeleton, const IncludeStore& includes)
    : root_(std::move(root)), skeleton_(std::move(skeleton)), includes_(&includes) {}

Element ReadModel::source_at(const std::string& file, int line) const {
    const Skeleton* included = includes_->skeleton_of(file);
    return element_at(included ? *included : skeleton_, line);
}

Element ReadModel::source_of(const sdf::ElementPtr& element) const {
    if (!element || !element->LineNumber()) return {};
    return source_at(element->FilePath(), *element->LineNumber());
}

LibsdformatReader::LibsdformatReader(const IncludeStore& includes, Diagnostics& diagnostics)
    : includes_(includes), diagnostics_(diagnostics) {}

std::unique_ptr<ReadModel> LibsdformatReader::read(Skeleton skeleton) {
    const auto [entry, is_new] = read_.try_emplace(skeleton.body);
    if (is_new) entry->second = parse(skeleton);
    if (!entry->second) return nullptr;
    return std::make_unique<ReadModel>(entry->second, std::move(skeleton), includes_);
}

std::shared_ptr<const sdf::Root> LibsdformatReader::parse(const Skeleton& skeleton) {
    auto root = std::make_shared<sdf::Root>();
    sdf::Errors errors;
    {
        const ConsoleCapture capture;
        if (!document_) {
            document_ = std::make_shared<sdf::SDF>();
            sdf::init(document_);
        }
        while (const auto child = document_->Root()->GetFirstElement()) document_->Root()->RemoveChild(child);
        sdf::ParserConfig config;
        config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
        config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
        config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::LOG);
        try {
            if (sdf::readString(skeleton.text(), config, document_, errors)) {
                const sdf::Errors more = root->Load(document_, config);
                errors.insert(errors.end(), more.begin(), more.end());
            }
        } catch (const std::exception& exception) {
            errors.emplace_back(sdf::ErrorCode::STRING_READ,
                                std::string("libsdformat failed: ") + exception.what());
        }
    }
    const bool readable = root->Model() != nullptr;
    report(errors, skeleton, readable);
    return readable ? root : nullptr;
}

void LibsdformatReader::report(const sdf::Errors& errors, const Skeleton& skeleton, bool readable) {
    const Element model = skeleton.lines.front();
    const bool joint_to_nowhere = std::any_of(errors.begin(), errors.end(), is_joint_to_nowhere);
    std::size_t reported = 0;
    for (const sdf::Error& error : errors) {
        if (is_consequence(error, joint_to_nowhere, reported)) continue;
        Element at;
        if (error.LineNumber()) {
            const Skeleton* included = includes_.skeleton_of(error.FilePath().value_or(""));
            at = element_at(included ? *included : skeleton, *error.LineNumber());
        }
        const std::string message = trimmed(error.Message());
        if (message.find("not defined in SDF") != std::string::npos) {
            const std::string attribute = bracketed(message, "Attribute");
            const std::string element = at ? at.node.name() : bracketed(message, "Element");
            const std::string parent = at ? at.node.parent().name() : bracketed(message, "element");
            diagnostics_.warning(at ? at.where() : model.where(), "unknown-element",
                                 attribute.empty() ? "<" + element + "> in <" + parent +
                                                         "> is not known to SDFormat and is ignored"
                                                   : "the attribute " + attribute + " of <" + element +
                                                         "> is not known to SDFormat and is ignored",
                                 "Check the spelling and the place.");
            continue;
        }
        // The first unreadable element says it all; its parents repeat it.
        if (error.Code() == sdf::ErrorCode::ELEMENT_INVALID && reported > 0) continue;
        if (at && message.rfind("Error reading element", 0) == 0) {
            diagnostics_.error(at.where(), "bad-value",
                               "<" + std::string(at.node.name()) + "> in <" + at.node.parent().name() +
                                   "> is '" + at.node.text().get() + "', which is no value for it",
                               "Write what the SDFormat specification says (http://sdformat.org/spec).");
            ++reported;
            continue;
        }
        if (!at) at = element_named_in(message, model);
        diagnostics_.error(
            at.where(), "sdf", "model '" + model.name() + "': " + message,
            "Correct the element as the SDFormat specification says (http://sdformat.org/spec).");
        ++reported;
    }
    if (!readable && reported == 0) {
        diagnostics_.error(model.where(), "sdf", "model '" + model.name() + "' cannot be read by libsdformat",
                           "Check it with: gz sdf --check FILE.");
    }
}

}  // namespace roboss::sdf_import
