#include <welkin/sh/forms/code_form.h>

#include <fmt/format.h>

#include <cassert>

namespace welkin {
namespace {

constexpr CodeForm c_form{
    "//",
    R"(Holds: irradiance over pi, degree 2, as a polynomial of the unit normal (x, y, z): the cosine, 1 / pi and the
constants of the basis are multiplied in. A constant environment L gives L. Linear Rec. 709.
Axes: right-handed, +Y up, -Z forward, as glTF.
Use: C99 or C++; color = albedo * welkin_irradiance_over_pi(n). It can be slightly negative: clamp at 0.
)",
    "static const float welkin_sh[9][3] = {\n",
    "    {",
    "}",
    "f",
    R"(};

static inline void welkin_irradiance_over_pi(const float n[3], float rgb[3]) {
  const float x = n[0], y = n[1], z = n[2];
  const float terms[9] = {1.0f, y, z, x, x * y, y * z, 3.0f * z * z - 1.0f, x * z, x * x - y * y};
  for (int channel = 0; channel < 3; ++channel) {
    rgb[channel] = 0.0f;
    for (int i = 0; i < 9; ++i) rgb[channel] += terms[i] * welkin_sh[i][channel];
  }
}
)"};

constexpr CodeForm glsl_form{
    "//",
    R"(Holds: irradiance over pi, degree 2, as a polynomial of the unit normal (x, y, z): the cosine, 1 / pi and the
constants of the basis are multiplied in. A constant environment L gives L. Linear Rec. 709.
Axes: right-handed, +Y up, -Z forward, as glTF; n is in world space.
Use: GLSL 1.20 and later, GLSL ES 3.00 and later. color = albedo * max(welkin_irradiance_over_pi(n), 0.0).
Either the nine constants, or, with fewer operations per vertex, the three matrices: v^T M v with v = (n, 1)
(Ramamoorthi & Hanrahan 2001, equations 11 and 12). Both give the same.
)",
    "const vec3 welkin_sh[9] = vec3[9](\n",
    "    vec3(",
    ")",
    "",
    R"();

vec3 welkin_irradiance_over_pi(vec3 n) {
  return welkin_sh[0] + welkin_sh[1] * n.y + welkin_sh[2] * n.z + welkin_sh[3] * n.x
      + welkin_sh[4] * (n.x * n.y) + welkin_sh[5] * (n.y * n.z) + welkin_sh[6] * (3.0 * n.z * n.z - 1.0)
      + welkin_sh[7] * (n.x * n.z) + welkin_sh[8] * (n.x * n.x - n.y * n.y);
}

)"};

constexpr CodeForm hlsl_form{
    "//",
    R"(Holds: irradiance over pi, degree 2, as a polynomial of the unit normal (x, y, z): the cosine, 1 / pi and the
constants of the basis are multiplied in. A constant environment L gives L. Linear Rec. 709.
Axes: right-handed, +Y up, -Z forward, as glTF; n is in world space.
Use: color = albedo * max(welkin_irradiance_over_pi(n), 0.0).
)",
    "static const float3 welkin_sh[9] = {\n",
    "    float3(",
    ")",
    "",
    R"(};

float3 welkin_irradiance_over_pi(float3 n) {
  return welkin_sh[0] + welkin_sh[1] * n.y + welkin_sh[2] * n.z + welkin_sh[3] * n.x
      + welkin_sh[4] * (n.x * n.y) + welkin_sh[5] * (n.y * n.z) + welkin_sh[6] * (3.0 * n.z * n.z - 1.0)
      + welkin_sh[7] * (n.x * n.z) + welkin_sh[8] * (n.x * n.x - n.y * n.y);
}
)"};

constexpr CodeForm unity_form{
    "//",
    R"(Holds: SphericalHarmonicsL2 sh[channel, coefficient], irradiance over pi as a polynomial of the normal: the cosine,
1 / pi and the constants of the basis are multiplied in. A constant environment L gives L. Linear color space.
Axes: Unity's world, left-handed, +Y up; welkin's (and glTF's) x is -x here, as UnityGLTF and glTFast import models.
Use: RenderSettings.ambientMode = AmbientMode.Custom; RenderSettings.ambientProbe = WelkinSh.Probe();
or MaterialPropertyBlock.CopySHCoefficientArraysFrom(new[] { WelkinSh.Probe() }). Unity gives it to shaders as
  unity_SHAr = (sh[0, 3], sh[0, 1], sh[0, 2], sh[0, 0] - sh[0, 6])      and so g and b, with sh[1, ...] and sh[2, ...]
  unity_SHBr = (sh[0, 4], sh[0, 5], 3 sh[0, 6], sh[0, 7])
  unity_SHC = (sh[0, 8], sh[1, 8], sh[2, 8], 1)
and ShadeSH9 evaluates red as
  dot(unity_SHAr, float4(n, 1)) + dot(unity_SHBr, n.xyzz * n.yzzx) + unity_SHC.r * (n.x * n.x - n.y * n.y)
)",
    R"(using UnityEngine.Rendering;

public static class WelkinSh
{
    static readonly float[,] coefficients =
    {
)",
    "        {",
    "}",
    "f",
    R"(    };

    public static SphericalHarmonicsL2 Probe()
    {
        var sh = new SphericalHarmonicsL2();
        for (int channel = 0; channel < 3; ++channel)
            for (int i = 0; i < 9; ++i)
                sh[channel, i] = coefficients[i, channel];
        return sh;
    }
}
)"};

constexpr CodeForm unreal_form{
    "//",
    R"(Holds: FSHVectorRGB3, coefficients of the radiance, orthonormal, with the Condon-Shortley sign: nothing is multiplied
in, though the engine's member is called IrradianceEnvironmentMap. Linear Rec. 709.
Axes: Unreal's world, left-handed, +Z up: (x, y, z) there is welkin's (and glTF's) (x, z, y), as its glTF importer does.
Use: the engine packs V = WelkinSkyRadiance() into View.SkyIrradianceEnvironmentMap
(SetupSkyIrradianceEnvironmentMapConstantsFromSkyIrradiance), for red, and so for green in [1], [4], blue in [2], [5]:
  [0] = (-a V[3], -a V[1], a V[2], V[0] / (2 sqrt(pi)) - c V[6])        a = sqrt(3) / (3 sqrt(pi))
  [3] = (b V[4], -b V[5], 3 c V[6], -b V[7])                            b = sqrt(15) / (8 sqrt(pi))
  [6] = (b / 2 R[8], b / 2 G[8], b / 2 B[8], 1)                         c = sqrt(5) / (16 sqrt(pi))
and GetSkySHDiffuse(n) gives irradiance over pi, for red
  max(0, dot([0], float4(n, 1)) + dot([3], n.xyzz * n.yzzx) + [6].x * (n.x * n.x - n.y * n.y))
)",
    R"(#include "Math/SHMath.h"

static const float WelkinSkyCoefficients[9][3] = {
)",
    "    {",
    "}",
    "f",
    R"(};

inline FSHVectorRGB3 WelkinSkyRadiance() {
  FSHVectorRGB3 Result;
  for (int Index = 0; Index < 9; ++Index) {
    Result.R.V[Index] = WelkinSkyCoefficients[Index][0];
    Result.G.V[Index] = WelkinSkyCoefficients[Index][1];
    Result.B.V[Index] = WelkinSkyCoefficients[Index][2];
  }
  return Result;
}
)"};

constexpr CodeForm godot_form{
    "#",
    R"(Holds: the nine colors of a light probe of a LightmapGI: coefficients of the radiance divided by pi, orthonormal, no
Condon-Shortley sign; the shader multiplies by the cosine and the constants of the basis. Linear Rec. 709.
Axes: Godot's world, right-handed, +Y up: the same as welkin's and glTF's.
Use: nine colors of the argument point_sh of RenderingServer.lightmap_set_probe_capture_data, for each probe.
The scene shader then has, with c = 0.886227, 1.023327, 0.858086, 0.247708, 0.429043, irradiance over pi as
  c[0] sh[0] + c[1] (sh[1] n.y + sh[2] n.z + sh[3] n.x) + c[2] (sh[4] n.x n.y + sh[5] n.y n.z + sh[7] n.x n.z)
  + c[3] sh[6] (3 n.z n.z - 1) + c[4] sh[8] (n.x n.x - n.y n.y)
)",
    "static func welkin_probe() -> PackedColorArray:\n\treturn PackedColorArray([\n",
    "\t\tColor(",
    ")",
    "",
    "\t])\n"};

constexpr std::string_view about_three =
    R"(Holds: coefficients of the radiance, orthonormal, no Condon-Shortley sign: SphericalHarmonics3, as a LightProbe has it.
Axes: three.js's world, right-handed, +Y up: the same as welkin's and glTF's.
Use: const probe = new THREE.LightProbe(); probe.sh.fromArray(file.sh); scene.add(probe); (three.js r155 and later)
The shader's shGetIrradianceAt gives irradiance (not over pi, which BRDF_Lambert has):
0.886227 sh[0] + 1.023328 (sh[1] y + sh[2] z + sh[3] x) + 0.858086 (sh[4] x y + sh[5] y z + sh[7] x z)
+ sh[6] (0.743125 z z - 0.247708) + 0.429043 sh[8] (x x - y y)
)";

constexpr std::string_view about_babylon =
    R"(Holds: SphericalPolynomial, which is also the member irradiance of an .env file's manifest: irradiance over pi, convolved
with the cosine over pi once more (what Babylon calls FromHarmonics); its materials take that back out (FromPolynomial).
Axes: Babylon's default world, left-handed, +Y up; welkin's (and glTF's) x is -x here, as its glTF loader's root node has
it. In a scene with useRightHandedSystem the environment lies turned by 180 degrees about y: turn it back with
texture.setReflectionTextureMatrix(BABYLON.Matrix.RotationY(Math.PI)).
Use: const p = new BABYLON.SphericalPolynomial(); for (const k in file.irradiance) p[k].copyFromFloats(...file.irradiance[k]);
scene.environmentTexture.sphericalPolynomial = p; with brdf.useSphericalHarmonics, which is the default, the material has
H = SphericalHarmonics.FromPolynomial(p) and computeEnvironmentIrradiance(n) gives irradiance over pi as its sum H Y(n).
)";

constexpr std::string_view about_filament =
    R"(Holds: irradiance over pi, degree 2, as a polynomial of the normal: the cosine, 1 / pi and the constants of the basis are
multiplied in ("pre-scaled"), the same lines as sh.txt of cmgen. A constant environment L gives L. Linear Rec. 709.
Axes: Filament's world, right-handed, +Y up: the same as welkin's and glTF's. cmgen itself puts the middle column of an
equirectangular map at +Z, welkin at +X: turn its cube maps, or use welkin's.
Use: IndirectLight::Builder().irradiance(3, sh); the shader's Irradiance_SphericalHarmonics is
sh[0] + sh[1] n.y + sh[2] n.z + sh[3] n.x + sh[4] n.y n.x + sh[5] n.y n.z + sh[6] (3 n.z n.z - 1) + sh[7] n.z n.x
+ sh[8] (n.x n.x - n.y n.y), at least 0
)";

}  // namespace

std::optional<std::string_view> comment_of(std::string_view line) {
  const auto trim = [&] {
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
    while (!line.empty() && (line.back() == ' ' || line.back() == '\r')) line.remove_suffix(1);
  };
  trim();
  const std::size_t sign = line.starts_with("//") ? 2 : line.starts_with("#") ? 1 : 0;
  if (sign == 0) return {};
  line.remove_prefix(sign);
  trim();
  return line;
}

const CodeForm& code_form(ShForm form) {
  switch (form) {
    case ShForm::c: return c_form;
    case ShForm::glsl: return glsl_form;
    case ShForm::hlsl: return hlsl_form;
    case ShForm::unity: return unity_form;
    case ShForm::unreal: return unreal_form;
    default: assert(form == ShForm::godot); return godot_form;
  }
}

std::string_view about_form(ShForm form) {
  switch (form) {
    case ShForm::three: return about_three;
    case ShForm::babylon: return about_babylon;
    default: assert(form == ShForm::filament); return about_filament;
  }
}

// Of the terms 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2 each mixed one is shared by two entries of the symmetric M.
std::string glsl_matrices(const ShFormNumbers& numbers) {
  constexpr const char* names[] = {"red", "green", "blue"};
  std::string text;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const auto c = [&](std::size_t i) { return numbers[i * 3 + channel]; };
    text += fmt::format(
        "const mat4 welkin_sh_{} = mat4(\n"
        "    {:.9g}, {:.9g}, {:.9g}, {:.9g},\n    {:.9g}, {:.9g}, {:.9g}, {:.9g},\n"
        "    {:.9g}, {:.9g}, {:.9g}, {:.9g},\n    {:.9g}, {:.9g}, {:.9g}, {:.9g});\n",
        names[channel], c(8), c(4) / 2, c(7) / 2, c(3) / 2, c(4) / 2, -c(8), c(5) / 2, c(1) / 2, c(7) / 2,
        c(5) / 2, 3 * c(6), c(2) / 2, c(3) / 2, c(1) / 2, c(2) / 2, c(0) - c(6));
  }
  return text + R"(
vec3 welkin_irradiance_over_pi_4x4(vec3 n) {
  vec4 v = vec4(n, 1.0);
  return vec3(dot(v, welkin_sh_red * v), dot(v, welkin_sh_green * v), dot(v, welkin_sh_blue * v));
}
)";
}

}  // namespace welkin
