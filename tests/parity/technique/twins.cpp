#include "parity/technique/twins.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace lychnite {

std::vector<std::vector<double>> combinations(const std::vector<std::vector<double>>& lists) {
  std::vector<std::vector<double>> all{{}};
  for (const std::vector<double>& list : lists) {
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& start : all)
      for (const double value : list) {
        longer.push_back(start);
        longer.back().push_back(double(float(value)));
      }
    all = std::move(longer);
  }
  return all;
}

std::vector<double> range(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + (to - from) * i / (count - 1));
  return values;
}

std::vector<glm::dvec3> directions() {
  std::vector<glm::dvec3> all{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  for (int i = 0; i < 40; ++i) {
    const double y = 1 - 2 * (i + 0.5) / 40, phi = 2.399963 * i, r = std::sqrt(1 - y * y);
    const glm::vec3 d(glm::normalize(glm::dvec3(r * std::cos(phi), y, r * std::sin(phi))));
    all.emplace_back(d);
  }
  all.emplace_back(glm::vec3(glm::normalize(glm::dvec3(1e-4, -1e-4, -1))));
  return all;
}

const std::vector<Twin>& twins() {
  static const std::vector<Twin> all = [] {
    std::vector<Twin> list = opticsTwins();
    for (Twin& twin : geometryTwins()) list.push_back(std::move(twin));
    return list;
  }();
  return all;
}

}  // namespace lychnite
