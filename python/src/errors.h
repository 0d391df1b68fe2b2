// Errors of the C++ side as the exceptions of roboss.errors.
#pragma once

#include "roboss/core/result.h"

namespace roboss_python {

/// Throws the exception of this name in roboss.errors. The GIL must be held.
[[noreturn]] void raise(const char* exception, const roboss::Error& error);

/// The value, or the exception.
template <class T>
T value_or_raise(roboss::Result<T> result, const char* exception) {
    if (!result) raise(exception, result.error());
    return std::move(result).value();
}

}  // namespace roboss_python
