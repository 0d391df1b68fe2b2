// What nearly all tests read, parsed once for all of them (cmake/test_options.cmake). Only headers that are
// large or used everywhere: a change of one of them compiles every test again.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "model/model.h"
#include "physics/step.h"
