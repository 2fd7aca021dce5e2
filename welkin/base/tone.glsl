// From linear light to what a display shows. Luminance comes in kcd/m^2, leaves in [0, 1] with the sRGB transfer.

// std140; see toneParameters in tone.hpp.
struct ToneParameters {
  vec4 balanceR, balanceG, balanceB;  // rows of the white balance, xyz
  float exposure;                     // from kcd/m^2 to film: 1 is where a sensor saturates
  float saturation;
  int curve;                          // the order of ToneCurve
  float padding;
};

FN Real luminanceOf(IN(Vec3) c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

// IEC 61966-2-1.
FN Real srgbFromLinear(IN(Real) x) {
  return select(x <= 0.0031308f, 12.92f * x, 1.055f * pow(max(x, 1e-6f), 0.41666667f) - 0.055f);
}
FN Real linearFromSrgb(IN(Real) x) {
  return select(x <= 0.04045f, x / 12.92f, pow((max(x, 0.0f) + 0.055f) / 1.055f, 2.4f));
}

// x / (1 + x^p)^(1/p): from slope 1 at 0 to 1 at infinity; p sets how sharply it bends.
FN Real toneBend(IN(Real) x, IN(Real) p) { return x * pow(1.0f + pow(max(x, 1e-6f), p), -1.0f / p); }

// The scale S of a branch that leaves the pivot with slope s and reaches `rise` after `run`: S bend(s run / S) = rise.
FN float toneBranchScale(float s, float run, float rise, float p) {
  return s * run * pow(pow(s * run / rise, p) - 1.0f, -1.0f / p);
}

// AgX (T. Sobotka 2022): a sigmoid of the logarithm about middle grey, which stays where it is. Range, slope and bends
// are a matter of taste: deeper skies than the base look.
FN Real toneAgxCurve(IN(Real) x) {
  float pivotX = 0.6f;
  float pivotY = 0.45865f;  // 0.18^(1/2.2)
  float slope = 2.6f;
  float toe = 1.6f;
  float shoulder = 2.1f;
  float toeScale = toneBranchScale(slope, pivotX, pivotY, toe);
  float shoulderScale = toneBranchScale(slope, 1.0f - pivotX, 1.0f - pivotY, shoulder);
  Real t = clamp((log2(max(x, 1e-7f) / 0.18f) + 9.0f) / 15.0f, 0.0f, 1.0f) - pivotX;
  Real scale = select(t < 0.0f, Real(-toeScale), Real(shoulderScale));
  return pivotY + scale * toneBend(t * (slope / scale), select(t < 0.0f, Real(toe), Real(shoulder)));
}

// The published inset pulls saturated light toward grey before the curve; the outset is its inverse.
FN Vec3 toneAgx(IN(Vec3) c) {
  Real r = toneAgxCurve(dot(c, Vec3(0.8424791f, 0.0784336f, 0.0792237f)));
  Real g = toneAgxCurve(dot(c, Vec3(0.0423282f, 0.8784686f, 0.0791661f)));
  Real b = toneAgxCurve(dot(c, Vec3(0.0423757f, 0.0784336f, 0.8791430f)));
  Vec3 v = Vec3(r, g, b);
  return Vec3(pow(max(dot(v, Vec3(1.1968790f, -0.0980209f, -0.0990297f)), 0.0f), 2.2f),
              pow(max(dot(v, Vec3(-0.0528969f, 1.1519031f, -0.0989612f)), 0.0f), 2.2f),
              pow(max(dot(v, Vec3(-0.0529716f, -0.0980435f, 1.1510737f)), 0.0f), 2.2f));
}

// ACES, fitted by S. Hill (BakingLab, 2016).
FN Real toneAcesCurve(IN(Real) x) {
  return (x * (x + 0.0245786f) - 0.000090537f) / (x * (0.983729f * x + 0.4329510f) + 0.238081f);
}
FN Vec3 toneAces(IN(Vec3) c) {
  Vec3 v = Vec3(toneAcesCurve(dot(c, Vec3(0.59719f, 0.35458f, 0.04823f))),
                toneAcesCurve(dot(c, Vec3(0.07600f, 0.90834f, 0.01566f))),
                toneAcesCurve(dot(c, Vec3(0.02840f, 0.13383f, 0.83777f))));
  return Vec3(dot(v, Vec3(1.60475f, -0.53108f, -0.07367f)), dot(v, Vec3(-0.10208f, 1.10813f, -0.00605f)),
              dot(v, Vec3(-0.00327f, -0.07276f, 1.07602f)));
}

// J. Hable, Filmic Tonemapping (GDC 2010); white at 11.2, exposure bias 2.
FN Real toneFilmicCurve(IN(Real) x) {
  return (x * (0.15f * x + 0.05f) + 0.004f) / (x * (0.15f * x + 0.5f) + 0.06f) - 0.0666667f;
}
FN Vec3 toneFilmic(IN(Vec3) c) {
  float white = 0.7251294f;  // the curve at 11.2
  return Vec3(toneFilmicCurve(2.0f * c.x) / white, toneFilmicCurve(2.0f * c.y) / white,
              toneFilmicCurve(2.0f * c.z) / white);
}

// Light on the film, in units of its saturation.
FN Vec3 toneExpose(IN(Vec3) light, IN(ToneParameters) p) {
  Vec3 c = Vec3(dot(light, Vec3(p.balanceR.x, p.balanceR.y, p.balanceR.z)),
                dot(light, Vec3(p.balanceG.x, p.balanceG.y, p.balanceG.z)),
                dot(light, Vec3(p.balanceB.x, p.balanceB.y, p.balanceB.z)));
  c = max(c * p.exposure, Vec3(0.0f));
  Real y = luminanceOf(c);
  return max(mix(Vec3(y, y, y), c, Real(p.saturation)), Vec3(0.0f));
}

// kcd/m^2 to display values.
FN Vec3 toneMap(IN(Vec3) light, IN(ToneParameters) p) {
  Vec3 c = toneExpose(light, p);
  if (p.curve == 0) c = toneAgx(c);
  if (p.curve == 1) c = toneAces(c);
  if (p.curve == 2) c = toneFilmic(c);
  return Vec3(srgbFromLinear(saturate(c.x)), srgbFromLinear(saturate(c.y)), srgbFromLinear(saturate(c.z)));
}
