#pragma once
// Published and exact numbers that the solver is held against, and where they are from. mu0: cosine of incidence, 0
// for diffuse light; R and T include all orders and the unscattered beam; black ground, no boundaries.
#include <limits>

namespace welkin::published {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Slab {
  double asymmetry, albedo, depth, mu0, reflected, transmitted;
  const char* source;
};
inline constexpr const char* kVanDeHulst = "van de Hulst 1980, as in Wang, Jacques and Zheng 1995";
inline constexpr const char* kAddingDoubling = "adding-doubling, discrete ordinates agreeing to 9 digits";
inline constexpr Slab kSlabs[] = {
    {0.75, 0.9, 2, 1.0, 0.0973946, 0.6609577, kVanDeHulst}, {0.85, 1, 1, 1.0, 0.04232, 0.95768, kAddingDoubling},
    {0.85, 1, 1, 0.5, 0.16488, 0.83512, kAddingDoubling},   {0.85, 1, 1, 0.2, 0.41872, kNone, kAddingDoubling},
    {0.85, 1, 1, 0.0, 0.13437, kNone, kAddingDoubling},     {0.85, 1, 4, 1.0, 0.19092, 0.80909, kAddingDoubling},
    {0.85, 1, 4, 0.5, 0.41602, 0.58398, kAddingDoubling},   {0.85, 1, 4, 0.2, 0.60632, kNone, kAddingDoubling},
    {0.85, 1, 4, 0.0, 0.34040, kNone, kAddingDoubling},     {0.85, 1, 16, 1.0, 0.55721, 0.44279, kAddingDoubling},
    {0.85, 1, 16, 0.5, 0.69741, 0.30260, kAddingDoubling},  {0.85, 1, 16, 0.2, 0.79553, kNone, kAddingDoubling},
    {0.85, 1, 16, 0.0, 0.65169, kNone, kAddingDoubling},    {0.85, 1, 64, 1.0, 0.84628, 0.15372, kAddingDoubling},
    {0.85, 1, 64, 0.5, 0.89497, 0.10503, kAddingDoubling},  {0.85, 1, 64, 0.2, 0.92903, kNone, kAddingDoubling},
    {0.85, 1, 64, 0.0, 0.87909, kNone, kAddingDoubling},    {0.0, 1, 1, 1.0, 0.34133, kNone, kAddingDoubling},
    {0.0, 1, 1, 0.5, 0.49838, kNone, kAddingDoubling},      {0.0, 1, 16, 1.0, 0.90363, kNone, kAddingDoubling},
    {0.0, 1, 16, 0.5, 0.93329, kNone, kAddingDoubling},
};

// Isotropic half-space: R = 1 - sqrt(1 - albedo) H, BRF = albedo H^2 / (4 (mu + mu0)), here at mu = mu0 = 1. `depth`
// stands for infinity: with albedo 1, depth 1000 takes 0.002 from the BRF of 1.057.
struct HalfSpace {
  double albedo, h, depth;
};
inline constexpr const char* kChandrasekhar = "Chandrasekhar 1960";
inline constexpr HalfSpace kHalfSpaces[] = {{0.9, 1.850099, 40.0}, {1.0, 2.907811, 1000.0}};

// Energy lost when paths in a conservative sphere of Henyey and Greenstein's g = 0.85 stop after N scatterings.
struct StoppedPaths {
  double depth;  // of the diameter
  unsigned scatterings;
  double lost;
};
inline constexpr double kStoppedPathsError = 0.002;
inline constexpr const char* kStoppedPathsSource = "Monte Carlo, +- 0.002";
inline constexpr StoppedPaths kStoppedPaths[] = {{30, 32, 0.191},   {30, 64, 0.029},    {30, 128, 0.0005},
                                                 {100, 64, 0.286},  {100, 128, 0.155},  {100, 256, 0.058},
                                                 {100, 512, 0.009}, {100, 1024, 0.0003}};

// I3RC phase I, case 1: 32 columns of 15.625 m, depth 2 in the first half and 18 in the second, 250 m thick, periodic
// in x, the same along y, g = 0.85, albedo 1, overhead sun.
inline constexpr const char* kI3rc = "I3RC consensus, Cahalan et al. 2005";
inline constexpr const char* kI3rcColumnsSource = "I3RC case 1, Monte Carlo";
inline constexpr double kI3rcReflected = 0.327595, kI3rcTransmitted = 0.672398, kI3rcNadir = 0.256396;
inline constexpr double kI3rcColumns[32] = {.27859, .26712, .25531, .24542, .23761, .23207, .22805, .22592,
                                            .22597, .22796, .23176, .23787, .24578, .25563, .26676, .27939,
                                            .32332, .36758, .39589, .41544, .43034, .44028, .44675, .45022,
                                            .44978, .44676, .44118, .43032, .41623, .39624, .36826, .32325};

struct HenyeyGreenstein {
  double asymmetry, values[5];  // at 0, 45, 90, 135, 180 degrees, 1/sr
};
inline constexpr const char* kClosedForm = "closed form";
inline constexpr HenyeyGreenstein kHenyeyGreenstein[] = {
    {0.5, {0.4774648, 0.1492038, 0.0427058, 0.0217987, 0.0176839}},
    {0.85, {6.5430365, 0.0588199, 0.0097682, 0.0044153, 0.0034877}}};

struct Droplets {
  double diameter, meanCosine, values[4];  // um; values at 0, 45, 90, 180 degrees, 1/sr
};
inline constexpr const char* kJendersie = "fit of Jendersie and d'Eon 2023";
inline constexpr Droplets kDroplets[] = {{10, 0.864164, {586.86, 0.0676066, 0.00172563, 0.012715}},
                                         {20, 0.879310, {2742.51, 0.0629513, 0.00114718, 0.010914}}};

}  // namespace welkin::published
