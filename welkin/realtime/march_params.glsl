// Parameters of the march (march.glsl), one block for a view.

struct MarchParams {
  PlanetParams planet;
  vec4 sun;             // xyz: direction toward the sun, w: powder
  vec4 ambientSky;      // radiance of the sky for the clouds in kcd/m^2, w: ambient gain
  vec4 skyAround;       // its mean radiance, for the air, kcd/m^2
  vec4 diffused;        // light that falls on the clouds, as isotropic radiance in kcd/m^2, w: share of it deep inside
  vec4 ambientGround;   // radiance of the lit ground in kcd/m^2, w: bounce gain
  vec4 groundAlbedo;    // w: 1 when the ground is drawn
  vec4 skyOpen;         // irradiance of level ground by the sky without clouds, klx
  vec4 skyIrradiance;   // on the ground, clouds counted in, klx; w: albedo of the droplets
  vec4 shadedAir;       // radiance of air in the clouds' shade in kcd/m^2, w: share of the air below that lies there;
                        // with a light volume: radiance for each klx that comes down there
  vec4 droplets;        // MiePhase of the first scattering
  float bottom, top, stepScale, minStep;
  float maxStep, maxDistance, earlyExit, footprintPerMetre;
  float contribution, octaveExtinction, eccentricity, octaveGain;
  float forwardG, backwardG, backwardWeight, rainAbsorption;
  int octaves, lightSteps, ambientSteps, refine;
  int fixedSteps, fixedStepsHorizon, cheapSearch, nubis;
  int maxTurns, groundSteps, useDroplets;
  float nearReach;      // m, all near steps toward the sun where the light volume's cells are finest
  float lightRatio;  // each step toward the sun against the last
  float transportPath;  // m, on which light inside the clouds forgets its direction
  float once;           // share of the sun's irradiance that light turned aside once sends back from where it is turned
  float skyBehind;      // 1 when the sky of the table stands behind the clouds, 0 for the host's picture
  vec4 rain;            // x: altitude above which none falls in m, y: share of its extinction that is drawn as particles
                        // as far as z in m, w: share of sunlight that the clouds leave it, without a light volume
};
