#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace lychnite {

/// What a cached result was made from, as numbers: equal keys mean that nothing needs to be done again.
class Key {
 public:
  Key& add(double value) {
    values_.push_back(value);
    return *this;
  }
  Key& add(const glm::dvec3& v) { return add(v.x).add(v.y).add(v.z); }
  Key& add(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r) add(m[c][r]);
    return *this;
  }
  Key& add(const Key& other) {
    values_.insert(values_.end(), other.values_.begin(), other.values_.end());
    return *this;
  }
  bool operator==(const Key&) const = default;

 private:
  std::vector<double> values_;
};

}  // namespace lychnite
