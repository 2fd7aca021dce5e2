#pragma once
// Skies that change with time: keyframes, and the day that passes.
//
// A parameter with keyframes has the first one's value before it and the last one's after it. Numbers, vectors and
// colours go from one to the next as the earlier keyframe says. Angles and hours that come round again go the short
// way. The sun's date and time are one moment: an hour earlier than that before it is of the next day; dates without
// hours go by whole days.
#include <string_view>

#include "welkin/scene/scene.hpp"

namespace welkin {

// The sky at a time (s): its keyframes' values set, itself without keyframes. What cannot be set, as a scene made by
// hand may have it, throws Error (badInput).
Scene sceneAt(const Scene& scene, double time);

// Takes a parameter's keyframes out; those of all that it sets with "quality.preset" and a hero cloud's species.
void dropKeyframes(Scene& scene, std::string_view path);

// Whether keyframes set the parameter of that path, or one of a section ("sun.").
bool hasKeyframes(const Scene& scene, std::string_view path);

// Lets the day go on by so many seconds: sun, moon and stars turn about the pole of the sun's latitude, or, where the
// sun has date and time, these go on.
void passDay(Scene& scene, double seconds);

// How far a number's field comes round again (360 for compass headings, 24 for hours), in the file's unit; 0: it does
// not.
double periodOf(const Field& field);

}  // namespace welkin
