// The cases' expressions as GLSL text.
#include "parity/glsl_as_cpp.h"

namespace lychnite {

#define LIB_CASE(function, expression) {#function, #expression},

const std::map<std::string, std::string>& libExpressions() {
  static const std::map<std::string, std::string> all{
#include "parity/technique/lib_cases.inc"
  };
  return all;
}

}  // namespace lychnite
