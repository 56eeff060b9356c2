#pragma once

#include <string>

namespace lychnite {

/// Today as 2026-12-31, UTC.
std::string today();

}  // namespace lychnite
