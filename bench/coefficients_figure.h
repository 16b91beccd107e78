#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

// The figure of bench_coefficients: a row for each method, a dot for each map's RMS error and a tick for its largest.

namespace bench {

/// Shares of the map's largest irradiance.
struct CoefficientErrors {
  double rms = 0, largest = 0, least = 0;
};

struct MapErrors {
  std::string name;
  std::vector<CoefficientErrors> errors;  // by method
};

inline std::string coefficients_figure(std::span<const char* const> methods,
                                       std::span<const MapErrors> maps) {
  constexpr double left = 240, right = 700, top = 60, row = 26;
  constexpr const char* colors[] = {"#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee",
                                    "#aa3377", "#882255", "#dd7733", "#44aa99", "#333333"};
  const auto x = [&](double error) {  // 0.01 % to 100 %, logarithmic
    return left + (right - left) * (std::log10(std::clamp(error, 1e-4, 1.0)) + 4) / 4;
  };
  const double bottom = top + row * static_cast<double>(methods.size());
  const double height = bottom + 50 + 18 * std::ceil(static_cast<double>(maps.size()) / 2);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 {0:g}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n<rect width=\"720\" height=\"{0:g}\" fill=\"white\"/>\n"
      "<text x=\"20\" y=\"22\" font-size=\"14\" font-weight=\"bold\">Error of irradiance, over the largest "
      "irradiance of the map</text>\n<text x=\"20\" y=\"42\">dot: RMS over all normals; bar to its right: "
      "the largest</text>\n",
      height);
  for (int decade = -4; decade <= 0; ++decade) {
    const double at = x(std::pow(10.0, decade));
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:g}\" y2=\"{2:g}\" stroke=\"#cccccc\"/>"
        "<text x=\"{0:.1f}\" y=\"{3:g}\" text-anchor=\"middle\">{4:g} %</text>\n",
        at, top, bottom, bottom + 16, 100 * std::pow(10.0, decade));
  }
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const double y = top + row * (static_cast<double>(i) + 0.5);
    svg += fmt::format("<text x=\"{:g}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", left - 10, y + 4,
                       methods[i]);
    for (std::size_t k = 0; k < maps.size(); ++k) {
      const CoefficientErrors& e = maps[k].errors[i];
      const double at = y + 18 * ((static_cast<double>(k) + 0.5) / static_cast<double>(maps.size()) - 0.5);
      const char* color = colors[k % std::size(colors)];
      svg += fmt::format(
          "<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\" "
          "stroke-width=\"1\"/>"
          "<circle cx=\"{0:.1f}\" cy=\"{2:.1f}\" r=\"2.5\" fill=\"{3}\"/>\n",
          x(e.rms), x(e.largest), at, color);
    }
  }
  for (std::size_t k = 0; k < maps.size(); ++k) {
    const double at_x = k % 2 ? 380 : 20, at_y = bottom + 40 + 18 * static_cast<double>(k / 2);
    svg += fmt::format(
        "<circle cx=\"{:g}\" cy=\"{:g}\" r=\"4\" fill=\"{}\"/><text x=\"{:g}\" y=\"{:g}\">{}</text>\n", at_x,
        at_y, colors[k % std::size(colors)], at_x + 10, at_y + 4, maps[k].name);
  }
  return svg + "</svg>\n";
}

}  // namespace bench
