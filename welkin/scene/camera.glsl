// Which way a pixel of a picture looks: the one map that all renderers share.

// std140; see cameraParams in camera.hpp.
struct CameraParams {
  vec4 forward;  // through the picture's centre; w: 0 perspective, 1 equirectangular
  vec4 right;    // perspective: what x = 1 adds to forward; equirectangular: a unit vector, as forward and above are
  vec4 above;    // the same for y = 1
  vec4 angles;   // equirectangular: azimuth from forward and elevation of the centre, half of what the picture spans
};

// The ray through a point of the picture: x from -1 on the left to 1 on the right, y from -1 below to 1 above. Unit
// length only when equirectangular; a perspective ray has length 1 along the axis.
FN Vec3 cameraRay(IN(Vec2) ndc, IN(CameraParams) c) {
  Vec3 forward = Vec3(c.forward.x, c.forward.y, c.forward.z);
  Vec3 right = Vec3(c.right.x, c.right.y, c.right.z);
  Vec3 above = Vec3(c.above.x, c.above.y, c.above.z);
  Real x = ndc.x;
  Real y = ndc.y;
  Real z = 1.0f;
  if (c.forward.w > 0.5f) {
    Real azimuth = c.angles.x + c.angles.z * ndc.x;
    Real elevation = c.angles.y + c.angles.w * ndc.y;
    x = cos(elevation) * sin(azimuth);
    y = sin(elevation);
    z = cos(elevation) * cos(azimuth);
  }
  return forward * z + right * x + above * y;
}
