// shaders/lib as double-precision C++: what its formulas are worth when rounding is out of the way.
#include "parity/glsl_as_cpp.h"

namespace lychnite {
namespace lib_double {

using namespace glm;

#define float double
#define vec2 dvec2
#define vec3 dvec3
#define vec4 dvec4
#include "parity/technique/lib_all.inc"

#define LIB_VIEW                                 \
  LightView {                                    \
    vec3(a), vec3(b), vec3(c), vec3(d), a.w, b.w \
  }
#define LIB_CASE(function, expression)                                                       \
  {#function, [](const CaseInputs<double>& in) -> vec4 {                                     \
     [[maybe_unused]] const vec4 &a = in[0], &b = in[1], &c = in[2], &d = in[3], &e = in[4]; \
     return expression;                                                                      \
   }},

const std::map<std::string, CaseFunction<double>>& cases() {
  static const std::map<std::string, CaseFunction<double>> all{
#include "parity/technique/lib_cases.inc"
  };
  return all;
}

#undef float
#undef vec2
#undef vec3
#undef vec4

}  // namespace lib_double

const std::map<std::string, CaseFunction<double>>& libDouble() {
  return lib_double::cases();
}

}  // namespace lychnite
