// shaders/lib as single-precision C++. CMake compiles this file with literals as floats, as they are in GLSL.
#include "parity/glsl_as_cpp.h"

namespace lychnite {
namespace lib_float {

using namespace glm;

#include "parity/technique/lib_all.inc"

#define LIB_VIEW                                 \
  LightView {                                    \
    vec3(a), vec3(b), vec3(c), vec3(d), a.w, b.w \
  }
#define LIB_CASE(function, expression)                                                       \
  {#function, [](const CaseInputs<float>& in) -> vec4 {                                      \
     [[maybe_unused]] const vec4 &a = in[0], &b = in[1], &c = in[2], &d = in[3], &e = in[4]; \
     return expression;                                                                      \
   }},

const std::map<std::string, CaseFunction<float>>& cases() {
  static const std::map<std::string, CaseFunction<float>> all{
#include "parity/technique/lib_cases.inc"
  };
  return all;
}

}  // namespace lib_float

const std::map<std::string, CaseFunction<float>>& libFloat() {
  return lib_float::cases();
}

}  // namespace lychnite
