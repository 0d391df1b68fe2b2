// The value of a Result, or its Error as an exception: what a benchmark does about one.
#pragma once

#include <stdexcept>

#include "core/result.h"

namespace roboss::bench {

template <class T>
T take(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().text());
    return std::move(result).value();
}

}  // namespace roboss::bench
