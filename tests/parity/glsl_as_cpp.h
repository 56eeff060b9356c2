#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <string>

// What lets shaders/lib be compiled as C++ (over GLM, inside a namespace of its own).
#define OUT(T) T&
#define INOUT(T) T&

namespace lychnite {

/// What a parity case is given at one grid point: five vectors, `a` to `e` in the cases' expressions.
template <class T>
using CaseInputs = std::array<glm::vec<4, T>, 5>;
template <class T>
using CaseFunction = glm::vec<4, T> (*)(const CaseInputs<T>&);

/// The expressions of lib_cases.inc by function name: as they are for GLSL, as float and as double C++.
const std::map<std::string, std::string>& libExpressions();
const std::map<std::string, CaseFunction<float>>& libFloat();
const std::map<std::string, CaseFunction<double>>& libDouble();

}  // namespace lychnite
