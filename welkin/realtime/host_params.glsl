// What the host's shaders know of a view (shaders/host.glsl); positions are relative to its eye, east-north-up.

struct HostParams {
  AtmosphereParams air;
  LightVolumeParams volume;
  PlanetParams planet;
  vec4 clip0, clip1, clip3;  // rows of the view's clip transform of such positions
  vec4 depthPlace;           // from picture coordinates to texels of the cloud depth: xy scale, zw offset
  vec4 skyAround;            // as in MarchParams
  vec4 skyOpen;              // as in MarchParams
  vec4 clearSky;             // irradiance of the open sky on level ground, klx
  vec4 shadedSky;            // the same under the clouds where there is no light volume
  vec4 shadedAir;            // as in MarchParams
  vec4 groundAlbedo;         // of the sky's own ground
  float bottom, top;         // of the clouds, m
  float extinction;          // that a cloud is taken to have all through, 1/m
  float hasVolume;           // 1 when there is a light volume
  float exposure;            // from kcd/m^2 to the target's units
  float cloudExposure;       // from the clouds' texture to the target's units
  float depthUnit, depthFar; // m for each unit of the cloud depth, and where it means that there is no cloud
  float yUp;                 // 1 when the host's y points up
  float rainScale;           // 1 / edge of the rain map, 1/m; 0 where nothing falls
  float freezing;            // altitude of 0 degrees C, m
  float spare0;
};
