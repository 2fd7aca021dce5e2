// Light of a flash inside the clouds.

struct LightningParams {
  vec4 flash;   // xyz: its place in cloud space, w: luminous intensity in kcd
  vec4 colour;  // linear Rec.709 of luminance 1
};

const float kFlashCore = 250.0f;   // m, half the length of a channel
const float kFlashDepth = 800.0f;  // m inside its tower, from which side ever it is looked at

// What a point `q` of cloud space scatters of it, as a radiance over its opacity (kcd/m^2). Light of a point source at a
// depth z in a cloud that only scatters leaves its face as a flux of power z / (2 pi r^3) (diffusion, by an image of the
// source beyond the face; Ishimaru 1978 ch. 9); near the source no more than the inverse square gives.
FN Vec3 lightningLight(IN(Vec3) q, IN(LightningParams) l) {
  Vec3 away = q - Vec3(l.flash.x, l.flash.y, l.flash.z);
  Real r2 = dot(away, away) + kFlashCore * kFlashCore;
  Real inverse = inversesqrt(r2);
  Real depth = min(kFlashDepth * inverse, 1.0f);
  return xyz(l.colour) * (l.flash.w * 0.636619772f * depth * (inverse * inverse));
}
