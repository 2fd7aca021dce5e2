// Light of a flash inside the clouds.

struct LightningParams {
  vec4 flash;  // xyz: its place in cloud space, w: luminous intensity in kcd
  vec4 colour;  // linear Rec.709 of luminance 1
};

const float kFlashCore = 120.0f;    // m, half the length of a channel
const float kFlashReach = 1800.0f;  // m, on which the light leaks out of a tower

// What a point `q` of cloud space with extinction `sigma` scatters of it, as a radiance over its opacity (kcd/m^2). Deep
// in the cloud light spreads as from a point source in a medium that only scatters, 3 sigma (1 - g) / r, and leaks out at
// the tower's sides; a tenth, by eye, goes straight as the inverse square.
FN Vec3 lightningLight(IN(Vec3) q, IN(Real) sigma, IN(LightningParams) l) {
  Vec3 away = q - Vec3(l.flash.x, l.flash.y, l.flash.z);
  Real d = sqrt(dot(away, away) + kFlashCore * kFlashCore);
  Real spread = 3.0f * 0.14f * min(sigma, 0.1f) * exp(-d * (1.0f / kFlashReach));
  return xyz(l.colour) * (l.flash.w * 0.0795774715f * (spread / d + 0.1f / (d * d)));
}
