#pragma once
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "measure.h"

#include <welkin/image/output_file.h>

// docs/pictures/levels.svg: error of the trilinear look-up against the number of levels.

namespace bench {

struct Curve {
  std::string map;
  int size = 0;
  int default_levels = 0;
  std::vector<std::pair<int, double>> points;  // levels, relative RMS
};

/// One panel a map (three curves each, in the order of `curves`), error on a logarithmic axis from 1 % to 30 %.
inline void write_levels_figure(const std::string& path, const std::vector<Curve>& curves) {
  const char* const colours[] = {"#c0392b", "#2471a3", "#1e8449"};
  const auto px = [](std::size_t panel, int levels) {
    return 60 + 250.0 * static_cast<double>(panel) + 32 * (levels - 4);
  };
  const auto py = [](double error) { return 30 + 149 * (std::log10(0.3) - std::log10(error)); };
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 300\" font-family=\"sans-serif\" "
      "font-size=\"11\">\n"
      "<rect width=\"800\" height=\"300\" fill=\"white\"/>\n";
  for (double e : {0.01, 0.03, 0.1, 0.3})
    svg += fmt::format(
        "<line x1=\"55\" x2=\"770\" y1=\"{0:.1f}\" y2=\"{0:.1f}\" stroke=\"#ddd\"/>"
        "<text x=\"50\" y=\"{1:.1f}\" text-anchor=\"end\">{2:g} %</text>\n",
        py(e), py(e) + 4, 100 * e);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::size_t panel = i / 3;
    const Curve& curve = curves[i];
    if (i % 3 == 0) {
      for (int levels = 4; levels <= 10; ++levels)
        svg += fmt::format("<text x=\"{:.0f}\" y=\"268\" text-anchor=\"middle\">{}</text>\n",
                           px(panel, levels), levels);
      svg +=
          fmt::format("<text x=\"{:.0f}\" y=\"18\" text-anchor=\"middle\" font-weight=\"bold\">{}</text>\n",
                      px(panel, 7), curve.map);
    }
    std::string line;
    for (const auto& [levels, error] : curve.points)
      line += fmt::format("{:.1f},{:.1f} ", px(panel, levels), py(error));
    svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>\n", line,
                       colours[i % 3]);
    for (const auto& [levels, error] : curve.points)
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", px(panel, levels),
                         py(error), levels == curve.default_levels ? 5 : 2.2, colours[i % 3]);
  }
  svg +=
      "<text x=\"415\" y=\"288\" text-anchor=\"middle\">levels (large dots: the default); size 128 "
      "<tspan fill=\"#c0392b\">red</tspan>, 256 <tspan fill=\"#2471a3\">blue</tspan>, 512 "
      "<tspan fill=\"#1e8449\">green</tspan>; relative RMS of trilinear look-ups</text>\n</svg>\n";
  welkin::write_file(path, svg);
}

}  // namespace bench
