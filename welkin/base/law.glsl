// The law's vocabulary, GLSL reading. The scalar C++ reading is law.hpp, the SIMD one law_simd-inl.hpp.
// Law files use only these names, the arithmetic operators, and the built-in functions that all three readings share.
#define FN
#define IN(T) in T
#define OUT(T) out T
#define INOUT(T) inout T
#define Real float
#define Vec2 vec2
#define Vec3 vec3
#define Vec4 vec4
#define Int int
#define IVec2 ivec2
#define IVec3 ivec3
#define Uint uint
#define Mask bool
#define Sampler2 sampler2D
#define Sampler3 sampler3D
#define Sampler2Array sampler2DArray

#define WELKIN_SELECT(T) T select(bool m, T a, T b) { return m ? a : b; }
WELKIN_SELECT(float)
WELKIN_SELECT(vec2)
WELKIN_SELECT(vec3)
WELKIN_SELECT(vec4)
WELKIN_SELECT(int)
WELKIN_SELECT(uint)
bool select(bool m, bool a, bool b) { return m ? a : b; }

bool both(bool a, bool b) { return a && b; }
bool either(bool a, bool b) { return a || b; }
bool invert(bool a) { return !a; }
// True when no lane of the mask is set: the only question about lanes that may steer control flow.
bool noneOf(bool m) { return !m; }
// A condition that is the same for all lanes, as a mask.
bool toMask(bool m) { return m; }

float toReal(int x) { return float(x); }
float toReal(uint x) { return float(x); }
int toInt(float x) { return int(x); }
int toInt(uint x) { return int(x); }
uint toUint(int x) { return uint(x); }
uint toUint(uint x) { return x; }
int floorInt(float x) { return int(floor(x)); }

vec2 xy(vec3 v) { return v.xy; }
vec2 xy(vec4 v) { return v.xy; }
vec2 zw(vec4 v) { return v.zw; }
vec3 xyz(vec4 v) { return v.xyz; }
float saturate(float x) { return clamp(x, 0.0, 1.0); }

vec4 sample2(sampler2D s, vec2 p) { return textureLod(s, p, 0.0); }
vec4 sample3(sampler3D s, vec3 p) { return textureLod(s, p, 0.0); }
vec4 sample2Array(sampler2DArray s, vec2 p, float layer) { return textureLod(s, vec3(p, layer), 0.0); }
