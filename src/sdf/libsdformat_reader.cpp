// Calls libsdformat.
#include "sdf/libsdformat_reader.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "sdf/console_capture.h"
#include "sdf/libsdformat_errors.h"

namespace roboss::sdf_import {
namespace {

Element element_at(const Skeleton& skeleton, int line) {
    const auto index = static_cast<std::size_t>(line - 1);
    return line >= 1 && index < skeleton.lines.size() ? skeleton.lines[index] : Element{};
}

/// What optional elements other than those `kept` may hold is forgotten. Plain values stay: they have
/// defaults.
void forget_children(const sdf::ElementPtr& description, std::initializer_list<std::string_view> kept) {
    for (unsigned i = 0; i < description->GetElementDescriptionCount(); ++i) {
        const sdf::ElementPtr child = description->GetElementDescription(i);
        const bool is_plain = child->GetElementDescriptionCount() == 0;
        if (is_plain || child->GetRequired() == "1") continue;
        if (std::ranges::find(kept, child->GetName()) == kept.end()) child->Reset();
    }
}

/// Forgets the descriptions of what no skeleton holds. libsdformat copies the description of a link, with all
/// that links may hold, for each link that it reads.
void forget_what_skeletons_lack(const sdf::ElementPtr& root) {
    const auto each = [](const sdf::ElementPtr& parent, std::initializer_list<const char*> names,
                         const auto& change) {
        for (const char* name : names)
            if (parent->HasElementDescription(name)) change(parent->GetElementDescription(name));
    };
    each(root, {"model"}, [&](const sdf::ElementPtr& model) {
        each(model, {"link"}, [&](const sdf::ElementPtr& link) {
            forget_children(link, {"pose", "inertial", "collision", "visual", "sensor", "light"});
            each(link, {"sensor"}, [](const sdf::ElementPtr& sensor) {
                forget_children(sensor, {"pose", "contact"});
            });
            each(link, {"visual"}, [&](const sdf::ElementPtr& visual) {
                forget_children(visual, {"pose", "geometry"});
                each(visual, {"geometry"},
                     [](const sdf::ElementPtr& geometry) { forget_children(geometry, {"sphere"}); });
            });
        });
        each(model, {"joint"}, [](const sdf::ElementPtr& joint) {
            forget_children(joint, {"pose", "axis", "axis2"});
        });
    });
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
    for (const Diagnostic& found : entry->second.found.items()) diagnostics_.add(found);
    if (!entry->second.root) return nullptr;
    return std::make_unique<ReadModel>(entry->second.root, std::move(skeleton), includes_);
}

struct LibsdformatReader::Heard {
    sdf::Errors errors;
    std::vector<ConsoleLine> printed;
};

LibsdformatReader::Known LibsdformatReader::parse(const Skeleton& skeleton) {
    auto root = std::make_shared<sdf::Root>();
    Heard heard;
    sdf::Errors& errors = heard.errors;
    {
        const ConsoleCapture capture;
        if (!document_) {
            document_ = std::make_shared<sdf::SDF>();
            sdf::init(document_);
            forget_what_skeletons_lack(document_->Root());
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
        heard.printed = capture.lines();
    }
    const bool readable = root->Model() != nullptr;
    Known known{readable ? root : nullptr, {}};
    report(heard, skeleton, readable, known.found);
    return known;
}

void LibsdformatReader::report(const Heard& heard, const Skeleton& skeleton, bool readable,
                               Diagnostics& out) const {
    const Element model = skeleton.lines.front();
    const auto locate = [&](const sdf::Error& error) {
        if (!error.LineNumber()) return Element{};
        const Skeleton* included = includes_.skeleton_of(error.FilePath().value_or(""));
        return element_at(included ? *included : skeleton, *error.LineNumber());
    };
    const std::size_t reported = report_libsdformat_errors(heard.errors, model, locate, out);
    // What it prints beside its errors: repetitions of them, or warnings that have no other way out.
    if (readable) {
        for (const ConsoleLine& line : heard.printed) {
            if (!line.is_error)
                out.warning(model.where(), "sdf", "model '" + model.name() + "': " + line.text);
        }
    }
    if (!readable && reported == 0) {
        out.error(model.where(), "sdf", "model '" + model.name() + "' cannot be read by libsdformat",
                  "Check it with: gz sdf --check FILE.");
    }
}

}  // namespace roboss::sdf_import
