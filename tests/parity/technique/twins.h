#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "parity/glsl_as_cpp.h"

namespace lychnite {

/// A function of shaders/lib, its independent double-precision twin, where they are compared and how closely.
/// Errors are relative to the twin's largest component, or to `floor` where that is smaller.
struct Twin {
  std::string function;
  std::function<glm::dvec4(const CaseInputs<double>&)> value;
  std::vector<CaseInputs<double>> grid;  ///< numbers that floats hold exactly
  double floor = 1e-6;
  double formula = 1e-12;  ///< bound of lib in double against the twin
  double rounding = 1e-6;  ///< bound of lib in float (C++) against the twin
  double driver = 1e-6;    ///< bound of lib as the driver runs it against lib in float
};
inline void PrintTo(const Twin& twin, std::ostream* out) {
  *out << twin.function;
}

/// One for each function of shaders/lib.
const std::vector<Twin>& twins();
std::vector<Twin> opticsTwins();
std::vector<Twin> geometryTwins();

/// All combinations of the values, one list for each number asked for, as float-exact doubles.
std::vector<std::vector<double>> combinations(const std::vector<std::vector<double>>& lists);
std::vector<double> range(double from, double to, int count);
/// Unit vectors all over the sphere, axes and near-axes among them.
std::vector<glm::dvec3> directions();

}  // namespace lychnite
