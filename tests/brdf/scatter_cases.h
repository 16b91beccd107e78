#pragma once
#include <cmath>
#include <string>
#include <vector>

#include <welkin/brdf/scatter/scatter_spec.h>

namespace welkin::scatter_test {

struct Case {
  std::string spec;
  bool lossless = false;
  OwnedScatter owned;

  const Scatter& scatter() const { return owned.scatter; }
};

inline const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> made;
    for (const char* spec : {"lambert:0.8:0.5:0.1",
                             "oren-nayar:0.5,0.8:0.4:0.2",
                             "phong:0",
                             "phong:1",
                             "phong:40,0.5:1:0.25",
                             "phong:100000",
                             "blinn-phong:0",
                             "blinn-phong:3",
                             "blinn-phong:100,0.3:0.6:0.9",
                             "lafortune:-1:-1:1:20",
                             "lafortune:-0.9:-0.6:1:8,0.4:0.8:0.2",
                             "lafortune:0.6:0.6:0.5:5",
                             "ggx:0.001,1",
                             "ggx:0.02,0.9:0.5:0.1",
                             "ggx:0.25",
                             "ggx:1,1",
                             "ggx:0.1:0.5,1:0.8:0.3",
                             "ggx:0.3,0.9:0.5:0.1,compensated",
                             "ggx-conductor:0.2,0.2:0.9:1.2,3.9:2.4:2.2",
                             "ggx-conductor:0.6,0.2:0.9:1.2,3.9:2.4:2.2,compensated",
                             "coated-diffuse:0.2,0.7:0.3:0.1",
                             "coated-diffuse:0,0.7:0.3:0.1,0.06",
                             "metallic-roughness:0.15,0.8:0.4:0.1,0.5",
                             "metallic-roughness:0.6,0.8:0.4:0.1,0,compensated"})
      made.push_back({spec, false, parse_scatter(spec)});
    for (const char* spec : {"lambert:1",
                             "oren-nayar:0,1",
                             "oren-nayar:0.4,1",
                             "oren-nayar:1.5,1",
                             "phong:0,1,compensated",
                             "phong:30,1,compensated",
                             "phong:3000,1,compensated",
                             "blinn-phong:2,1,compensated",
                             "blinn-phong:200,1,compensated",
                             "lafortune:-0.9:-0.6:1:8,1,compensated",
                             "ggx:0.003,1,compensated",
                             "ggx:0.05,1,compensated",
                             "ggx:0.4,1,compensated",
                             "ggx:1,1,compensated",
                             "ggx:0.1:0.5,1,compensated",
                             "coated-diffuse:0,1",
                             "coated-diffuse:0.05,1",
                             "coated-diffuse:0.7,1,0.2,compensated",
                             "metallic-roughness:0.3,1,0,compensated",
                             "metallic-roughness:0.1,1,0.5,compensated",
                             "metallic-roughness:0.5:0.2,1,0.3,compensated",
                             "metallic-roughness:0.8,1,1,compensated"})
      made.push_back({spec, true, parse_scatter(spec)});
    return made;
  }();
  return all;
}

/// Views of each test, oblique to both tangents.
inline std::vector<Vec3f> views() {
  std::vector<Vec3f> all;
  for (const float z : {0.97f, 0.5f, 0.12f}) {
    const float s = std::sqrt(1 - z * z);
    all.push_back({0.8f * s, -0.6f * s, z});
  }
  return all;
}

}  // namespace welkin::scatter_test
