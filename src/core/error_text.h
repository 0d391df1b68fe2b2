// The text of an Error that crossed a place where only text passes: the what() of a control program's
// exception.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "core/result.h"

namespace roboss {

/// The Error whose message is `before` and `text`. If `text` ends with a remedy as Error::text() writes it,
/// that is the remedy of the Error: who wrote the text knows better what to do. Otherwise the remedy is
/// `otherwise`.
inline Error error_of_text(const std::string& before, std::string text, std::string otherwise,
                           std::string code) {
    constexpr std::string_view kMark = "\n  remedy: ";
    const std::size_t at = text.rfind(kMark);
    if (at == std::string::npos) return {before + text, std::move(otherwise), std::move(code)};
    std::string remedy = text.substr(at + kMark.size());
    text.resize(at);
    return {before + text, std::move(remedy), std::move(code)};
}

}  // namespace roboss
