#include "lychnite/optics/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lychnite {
namespace {

/// Fresnel's equations in their sine and tangent form, which shares nothing with the implementation's.
double byAngles(double cosI, double eta) {
  const double i = std::acos(cosI), t = std::asin(std::sin(i) / eta);
  const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
  return 0.5 * (s * s + p * p);
}

/// Composite Simpson of f over [a, b].
template <class F>
double integrate(F f, double a, double b, int steps = 20000) {
  const double h = (b - a) / steps;
  double sum = f(a) + f(b);
  for (int i = 1; i < steps; ++i) sum += f(a + i * h) * (i % 2 ? 4 : 2);
  return sum * h / 3;
}

TEST(Fresnel, NormalIncidenceIsTheTextbookValue) {
  EXPECT_NEAR(fresnelReflectance(1, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnelReflectance(1, 1 / 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnelReflectance(1, 1.3), 0.09 / (2.3 * 2.3), 1e-15);
}

TEST(Fresnel, GrazingLightIsReflected) {
  for (double eta : {1.1, 1.3, 2.0}) {
    EXPECT_DOUBLE_EQ(fresnelReflectance(0, eta), 1);
    EXPECT_GT(fresnelReflectance(1e-4, eta), 0.99);
  }
}

TEST(Fresnel, AgreesWithTheSineAndTangentForm) {
  for (double eta : {1 / 1.5, 1 / 1.3, 1.05, 1.3, 1.5, 2.5, 4.0})
    for (double c = 0.01; c < 0.995; c += 0.01) {
      if (std::sqrt(1 - c * c) / eta >= 1) continue;
      EXPECT_NEAR(fresnelReflectance(c, eta), byAngles(c, eta), 1e-12) << eta << " " << c;
      EXPECT_DOUBLE_EQ(fresnelTransmittance(c, eta), 1 - fresnelReflectance(c, eta));
    }
}

TEST(Fresnel, BrewstersAngleLeavesOnlyThePerpendicularHalf) {
  const double eta = 1.5, cosB = 1 / std::sqrt(1 + eta * eta);
  const double perpendicular = (1 - eta * eta) / (1 + eta * eta);
  EXPECT_NEAR(fresnelReflectance(cosB, eta), 0.5 * perpendicular * perpendicular, 1e-14);
}

TEST(Fresnel, IndexMatchedSurfaceIsNotThere) {
  for (double c : {0.0, 1e-3, 0.5, 1.0}) EXPECT_EQ(fresnelReflectance(c, 1), 0) << c;
  EXPECT_EQ(diffuseFresnelReflectance(1), 0);
  EXPECT_EQ(diffuseTransmittanceOutside(1), 1);
  EXPECT_EQ(internalMoment(1, 1), 0);
  EXPECT_NEAR(exitLobe(0.3, 1), 1 / std::numbers::pi, 1e-15);
}

TEST(Fresnel, TotalInternalReflection) {
  const double eta = 1 / 1.5, critical = std::sqrt(1 - eta * eta);
  EXPECT_EQ(fresnelReflectance(critical - 1e-9, eta), 1);
  EXPECT_LT(fresnelReflectance(critical + 1e-3, eta), 1);
}

TEST(Fresnel, SameFromBothSides) {
  for (double c : {0.1, 0.4, 0.8}) {
    const double eta = 1.4, cosT = std::sqrt(1 - (1 - c * c) / (eta * eta));
    EXPECT_NEAR(fresnelReflectance(c, eta), fresnelReflectance(cosT, 1 / eta), 1e-13);
  }
}

TEST(Fresnel, DiffuseTransmittanceIsTheIntegral) {
  for (double eta : {1.0001, 1.0009, 1.0011, 1.01, 1.1, 1.3, 1.5, 2.0, 4.0}) {
    // mu = t^2 takes the square root at grazing angles out of Simpson's way.
    const double exact =
        integrate([&](double t) { return 4 * (1 - fresnelReflectance(t * t, eta)) * t * t * t; }, 0, 1);
    // Near 1 it is a sum of 2048 steps, above a closed form.
    EXPECT_NEAR(diffuseTransmittanceOutside(eta), exact, eta < 1.001 ? 1e-6 : 1e-8) << eta;
  }
  EXPECT_NEAR(diffuseTransmittanceOutside(1 / 1.5), diffuseTransmittanceOutside(1.5) / 2.25, 1e-15);
  EXPECT_NEAR(1 - diffuseTransmittanceOutside(1.5), 0.0918, 5e-5) << "Judd 1942";
}

TEST(Fresnel, InsideAndOutsideAreTiedByTheSquareOfTheIndex) {
  // Internal and external diffuse transmittance of one surface: (1 - Fdr_in) eta^2 = 1 - Fdr_out.
  for (double eta : {1.05, 1.3, 1.5, 2.0, 3.0})
    EXPECT_NEAR((1 - 2 * internalMoment(eta, 1)) * eta * eta, diffuseTransmittanceOutside(eta), 1e-6) << eta;
}

TEST(Fresnel, InternalMomentsAreTheIntegrals) {
  for (double eta : {1.3, 1.5}) {
    const double critical = std::sqrt(1 - 1 / (eta * eta));
    for (int i : {1, 2}) {
      const auto f = [&](double x) {
        const double mu = critical + (1 - critical) * x * x;
        return fresnelReflectance(mu, 1 / eta) * std::pow(mu, i) * 2 * x * (1 - critical);
      };
      EXPECT_NEAR(internalMoment(eta, i), std::pow(critical, i + 1) / (i + 1) + integrate(f, 0, 1), 1e-7)
          << eta;
    }
  }
}

TEST(Fresnel, RationalFitIsCloseToTheIntegral) {
  // Egan & Hilgeman's fit for eta > 1 is within 0.008 of the exact mean up to 2; above it is exact.
  for (double eta = 1.2; eta < 4.0; eta += 0.05)
    EXPECT_NEAR(diffuseFresnelReflectance(eta), 2 * internalMoment(eta, 1), 0.008) << eta;
  EXPECT_NEAR(diffuseFresnelReflectance(1.3), 0.444762, 1e-6);
  // Below 1 it is the mean over the side the light cannot be trapped on.
  for (double eta = 0.55; eta < 0.95; eta += 0.05)
    EXPECT_NEAR(diffuseFresnelReflectance(eta), 1 - diffuseTransmittanceOutside(1 / eta), 0.03) << eta;
}

TEST(Fresnel, ExitLobeIntegratesToOne) {
  for (double eta : {1.0, 1.3, 1.5, 4.0}) {
    const auto f = [&](double t) { return 2 * std::numbers::pi * exitLobe(t * t, eta) * 2 * t * t * t; };
    EXPECT_NEAR(integrate(f, 0, 1, 2000), 1, 1e-6) << eta;
  }
}

TEST(Refract, ObeysSnellInThePlaneOfIncidence) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.2, 1, -0.3));
  for (double eta : {1 / 1.5, 1.0, 1.3, 2.0})
    for (double x : {-0.5, 0.0, 0.4}) {
      const glm::dvec3 d = glm::normalize(glm::dvec3(x, -1, 0.3));
      const auto t = refract(d, n, eta);
      ASSERT_TRUE(t) << eta << " " << x;
      EXPECT_NEAR(glm::length(*t), 1, 1e-14);
      EXPECT_NEAR(glm::length(glm::cross(d, n)), eta * glm::length(glm::cross(*t, n)), 1e-13);
      EXPECT_NEAR(glm::dot(*t, glm::cross(d, n)), 0, 1e-14) << "out of the plane";
      EXPECT_LT(glm::dot(*t, n), 0);
    }
}

TEST(Refract, NothingBeyondTheCriticalAngle) {
  const glm::dvec3 n(0, 0, 1);
  const double critical = std::asin(1 / 1.5);
  const auto at = [](double angle) { return glm::dvec3(std::sin(angle), 0, -std::cos(angle)); };
  EXPECT_FALSE(refract(at(critical + 1e-6), n, 1 / 1.5));
  EXPECT_TRUE(refract(at(critical - 1e-6), n, 1 / 1.5));
}

}  // namespace
}  // namespace lychnite
