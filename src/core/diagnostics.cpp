// Collects and prints diagnostics.
#include "core/diagnostics.h"

#include <algorithm>
#include <utility>

namespace roboss {

const char* to_text(Severity severity) {
    switch (severity) {
        case Severity::kNote:
            return "note";
        case Severity::kWarning:
            return "warning";
        case Severity::kError:
            return "error";
    }
    return "?";
}

std::string to_text(const Diagnostic& d) {
    std::string text = d.where.file;
    if (d.where.line > 0) text += ":" + std::to_string(d.where.line);
    if (!text.empty()) text += ": ";
    text += std::string(to_text(d.severity)) + ": " + d.message;
    if (!d.code.empty()) text += " [" + d.code + "]";
    if (!d.remedy.empty()) text += "\n    " + d.remedy;
    return text;
}

void Diagnostics::note(SourceLocation where, std::string code, std::string message, std::string remedy) {
    add({Severity::kNote, std::move(where), std::move(code), std::move(message), std::move(remedy)});
}

void Diagnostics::warning(SourceLocation where, std::string code, std::string message, std::string remedy) {
    add({Severity::kWarning, std::move(where), std::move(code), std::move(message), std::move(remedy)});
}

void Diagnostics::error(SourceLocation where, std::string code, std::string message, std::string remedy) {
    add({Severity::kError, std::move(where), std::move(code), std::move(message), std::move(remedy)});
}

std::size_t Diagnostics::count(Severity severity) const {
    return static_cast<std::size_t>(std::count_if(
        items_.begin(), items_.end(), [&](const Diagnostic& d) { return d.severity == severity; }));
}

bool Diagnostics::has_errors() const {
    return count(Severity::kError) > 0;
}

bool Diagnostics::refuses_since(std::size_t first) const {
    const auto from = items_.begin() + static_cast<std::ptrdiff_t>(std::min(first, items_.size()));
    return std::any_of(from, items_.end(),
                       [](const Diagnostic& d) { return d.severity == Severity::kError && !d.left_out; });
}

bool Diagnostics::leave_out_since(std::size_t first) {
    bool any = false;
    for (std::size_t i = first; i < items_.size(); ++i) {
        if (items_[i].severity != Severity::kError) continue;
        items_[i].left_out = any = true;
    }
    return any;
}

void Diagnostics::refuse_since(std::size_t first) {
    for (std::size_t i = first; i < items_.size(); ++i) items_[i].left_out = false;
}

}  // namespace roboss
