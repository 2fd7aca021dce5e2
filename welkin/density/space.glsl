// Cloud space: (x, y relative to the anchor in the tangent plane of the world's origin, altitude above the ground).

// The planet seen from an anchor: unit vector away from its centre, distance to the centre, altitude, radius; in m.
struct PlanetParams {
  vec4 up;  // w: distance of the anchor from the centre
  float altitude, radius, spare0, spare1;
};

// Altitude of the point at offset d from the anchor. Stable in float: no difference of large numbers.
FN Real altitudeAt(IN(Vec3) d, IN(PlanetParams) p) {
  Real along = 2.0f * p.up.w * (d.x * p.up.x + d.y * p.up.y + d.z * p.up.z) + dot(d, d);
  return (p.altitude * (2.0f * p.radius + p.altitude) + along) / (sqrt(p.up.w * p.up.w + along) + p.radius);
}

FN Vec3 cloudSpace(IN(Vec3) d, IN(PlanetParams) p) { return Vec3(d.x, d.y, altitudeAt(d, p)); }

// Distances along the unit vector `dir` at which the ray from the anchor crosses altitude h: (nearer, farther), both
// negative when it never does.
FN Vec2 crossings(IN(Vec3) dir, IN(float) h, IN(PlanetParams) p) {
  Real b = p.up.w * (dir.x * p.up.x + dir.y * p.up.y + dir.z * p.up.z);
  float c = (p.altitude - h) * (2.0f * p.radius + p.altitude + h);
  Real disc = b * b - c;
  Real root = sqrt(max(disc, 0.0f));
  Real q = -b - select(b < 0.0f, -root, root);
  Real other = select(abs(q) > 1e-6f, c / select(abs(q) > 1e-6f, q, Real(1.0f)), Real(0.0f));
  return select(disc < 0.0f, Vec2(-1.0f, -1.0f), Vec2(min(q, other), max(q, other)));
}
