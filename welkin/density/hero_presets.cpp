// The species of hero clouds. Sizes and extinctions by what the WMO's cloud atlas shows; the rest by eye.
#include "welkin/density/hero.hpp"

namespace welkin {

namespace {

constexpr float kIceAsymmetry = 0.78f;  // .75 to .82 for ice

void makeIce(HeroCloud& cloud) {
  cloud.phase = ScatteringPhase::henyey_greenstein;
  cloud.asymmetry = kIceAsymmetry;
}

Hero humilis(Hero h) {
  h.cloud.position.z = 1000.0;
  h.cloud.extinction = 0.2f;
  h.form = {.width = 420.0f,
            .breadth = 0.69f,
            .height = 140.0f,
            .parts = 12,
            .towerRadius = 0.145f,
            .rimRadius = 0.07f,
            .rimHeight = 0.45f,
            .waist = 0.0f,
            .lean = 0.0f,
            .pucks = 5};
  h.surface.gain = 0.95f;
  h.surface.octaves = 5;
  h.surface.edge = 6.0f;
  h.surface.taper = 0.02f;
  return h;
}

Hero mediocris(Hero h) {
  h.cloud.position.z = 1100.0;
  h.cloud.extinction = 0.2f;
  h.form = {.width = 900.0f,
            .breadth = 0.69f,
            .height = 750.0f,
            .parts = 11,
            .towerRadius = 0.17f,
            .rimRadius = 0.1f,
            .rimHeight = 0.3f,
            .waist = 0.06f,
            .lean = 0.03f,
            .pucks = 4};
  h.surface.edge = 10.0f;
  h.surface.taper = 0.025f;
  return h;
}

Hero calvus(Hero h) {
  h.cloud.extinction = 0.15f;
  h.cloud.updraft = 5.0f;
  h.form = {.width = 7000.0f,
            .breadth = 0.75f,
            .height = 9500.0f,
            .parts = 13,
            .towerRadius = 0.23f,
            .rimRadius = 0.11f,
            .rimHeight = 0.25f,
            .waist = 0.08f,
            .lean = 0.04f};
  h.surface.topEdge = 10.0f;
  h.surface.topBillow = 0.3f;
  return h;
}

Hero incus(Hero h) {
  h.cloud.updraft = 8.0f;
  h.form = {.width = 9000.0f,
            .breadth = 0.75f,
            .height = 10500.0f,
            .parts = 13,
            .towerRadius = 0.2f,
            .rimRadius = 0.11f,
            .rimHeight = 0.25f,
            .waist = 0.1f,
            .lean = 0.05f,
            .anvil = 11000.0f,
            .anvilThickness = 0.11f,
            .anvilDensity = 0.015f};
  h.surface.edge = 25.0f;
  return h;
}

Hero lenticularis(Hero h) {
  h.cloud.position.z = 4500.0;
  h.cloud.extinction = 0.03f;
  h.cloud.drift = 0.0f;
  h.form = {.shape = HeroShape::plates, .width = 6000.0f, .breadth = 0.74f, .height = 1350.0f, .parts = 4};
  h.surface.edge = 55.0f;
  h.surface.wisp = 0.045f;
  return h;
}

Hero stratusFractus(Hero h) {
  h.cloud.position.z = 350.0;
  h.cloud.extinction = 0.09f;
  h.form = {.shape = HeroShape::patches, .width = 900.0f, .breadth = 0.6f, .height = 220.0f, .parts = 9};
  return h;
}

Hero cirrusUncinus(Hero h) {
  h.cloud.position.z = 7500.0;
  h.cloud.extinction = 0.006f;
  makeIce(h.cloud);
  h.form = {.shape = HeroShape::filaments, .width = 9000.0f, .breadth = 0.6f, .height = 1900.0f, .parts = 10};
  return h;
}

Hero mammatus(Hero h) {
  h.cloud.position.z = 3500.0;
  h.cloud.extinction = 0.03f;
  h.form = {.shape = HeroShape::pouches, .width = 6000.0f, .breadth = 0.8f, .height = 1300.0f};
  h.surface.billow = 1.1f;
  h.surface.billowSize = 0.2f;
  h.surface.edge = 45.0f;
  return h;
}

Hero castellanus(Hero h) {
  h.cloud.position.z = 3200.0;
  h.cloud.extinction = 0.05f;
  h.form = {.shape = HeroShape::rows,
            .width = 4200.0f,
            .breadth = 0.4f,
            .height = 740.0f,
            .parts = 24,
            .towerRadius = 0.036f,
            .rimRadius = 0.018f,
            .rimHeight = 0.4f,
            .waist = 0.05f,
            .lean = 0.05f};
  h.surface.billowSize = 0.09f;
  h.surface.edge = 9.0f;
  h.surface.taper = 0.008f;
  h.surface.baseNoise = 0.01f;
  h.surface.wisp = 0.01f;
  return h;
}

}  // namespace

Hero heroPreset(HeroSpecies species) {
  Hero plain;
  plain.cloud.species = species;
  switch (species) {
    case HeroSpecies::humilis:
      return humilis(plain);
    case HeroSpecies::mediocris:
      return mediocris(plain);
    case HeroSpecies::congestus:
      return plain;
    case HeroSpecies::calvus:
      return calvus(plain);
    case HeroSpecies::incus:
      return incus(plain);
    case HeroSpecies::lenticularis:
      return lenticularis(plain);
    case HeroSpecies::stratus_fractus:
      return stratusFractus(plain);
    case HeroSpecies::cirrus_uncinus:
      return cirrusUncinus(plain);
    case HeroSpecies::mammatus:
      return mammatus(plain);
    case HeroSpecies::altocumulus_castellanus:
      return castellanus(plain);
  }
  return plain;
}

void setSpecies(Hero& hero, HeroSpecies species) {
  const HeroCloud place = hero.cloud;
  const HeroScatter scatter = hero.scatter;
  hero = heroPreset(species);
  hero.cloud.position.x = place.position.x;
  hero.cloud.position.y = place.position.y;
  hero.cloud.heading = place.heading;
  hero.cloud.scale = place.scale;
  hero.cloud.seed = place.seed;
  hero.scatter = scatter;
}

}  // namespace welkin
