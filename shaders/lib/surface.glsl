// The coat: GGX microfacets over a Lambertian base. Twin: optics/surface.h. Needs lib/fresnel.glsl.

// Walter et al. 2007 eq. 33, by the squared sine between n and h: in single precision the cosine says nothing about a
// smooth coat's narrow peak.
float ggxDistribution(float sin2H, float alpha) {
  float a2 = alpha * alpha;
  float d = sin2H + (1.0 - sin2H) * a2;
  return a2 / (3.141592653589793 * d * d);
}

// G2 / (4 cosI cosO), Heitz 2014 eq. 99 (height-correlated Smith).
float smithVisibility(float cosI, float cosO, float alpha) {
  float a2 = alpha * alpha;
  float shadowing = cosO * sqrt(a2 + (1.0 - a2) * cosI * cosI);
  float masking = cosI * sqrt(a2 + (1.0 - a2) * cosO * cosO);
  return 0.5 / (shadowing + masking);
}

// BRDF times cosI; n, wo, wi unit and away from the surface; 0 when either is behind.
vec3 surfaceResponse(vec3 base, float eta, float roughness, float piC, vec3 n, vec3 wo, vec3 wi) {
  float cosI = dot(n, wi);
  float cosO = dot(n, wo);
  if (cosI <= 0.0 || cosO <= 0.0) return vec3(0.0);
  float alpha = roughness * roughness;
  vec3 h = normalize(wi + wo);
  vec3 across = cross(n, h);
  float specular = fresnelReflectance(max(0.0, dot(h, wi)), eta) * ggxDistribution(dot(across, across), alpha) *
                   smithVisibility(cosI, cosO, alpha);
  float diffuse = (1.0 - fresnelReflectance(cosI, eta)) * exitLobe(cosO, eta, piC);
  return (vec3(specular) + base * diffuse) * cosI;
}
