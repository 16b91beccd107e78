#include <fmt/format.h>

#include <cmath>
#include <vector>

#include <welkin/image/codecs/ldr.h>

#include "compare_pictures.h"
#include "ibl_report.h"
#include "ibl_report_style.h"

namespace welkin {
namespace {

// RFC 4648, with padding.
std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t group = std::uint32_t{bytes[i]} << 16 |
                                (left > 1 ? std::uint32_t{bytes[i + 1]} << 8 : 0) |
                                (left > 2 ? std::uint32_t{bytes[i + 2]} : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string figure(const ByteImage& picture, const std::string& alt, const std::string& caption) {
  return fmt::format(
      "<figure><img src=\"data:image/png;base64,{}\" alt=\"{}\">\n<figcaption>{}</figcaption></figure>\n",
      base64(encode_png(picture)), escape_html(alt), escape_html(caption));
}

std::string row(std::string_view title, const std::string& value) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td></tr>\n", title, value);
}

std::string table(const std::string& rows) {
  return "<div class=\"scroll\"><table>\n<tbody>\n" + rows + "</tbody>\n</table></div>\n";
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "&ndash;"; }

std::string figures_table(const CompareReport& report) {
  const ImageDifference& d = report.figures;
  const auto width = static_cast<std::size_t>(report.shown.a.width);
  return table(row("RMSE", number(d.rmse)) + row("Relative RMSE", number(d.relative_rmse)) +
               row("PSNR, dB", number(d.psnr_db)) + row("Largest difference", number(d.max_abs)) +
               row("at x, y", fmt::format("{}, {}", d.max_pixel % width, d.max_pixel / width)) +
               row("Perceptual difference, mean", number(report.perceptual.mean)) +
               row("its median", number(report.perceptual.median)) +
               row("its largest value", number(report.perceptual.largest)) +
               row("at pixels per degree", number(report.pixels_per_degree)));
}

std::string z_table(const ZTest& z) {
  const std::string verdict =
      z.equal ? "<p>The pictures are equal within their errors (1 % significance).</p>\n"
              : "<p>The pictures are not equal within their errors (1 % significance).</p>\n";
  return "<section>\n<h2>Against their standard errors</h2>\n" + verdict +
         table(row("Scores", fmt::format("{}", z.count)) +
               row("Beyond 2 standard errors (expected 4.550 %)",
                   fmt::format("{:.3f} %", 100 * z.share_beyond_2)) +
               row("Beyond 3 standard errors (expected 0.270 %)",
                   fmt::format("{:.3f} %", 100 * z.share_beyond_3)) +
               row("Mean square of scores (expected 1)", number(z.mean_square)) +
               row("Mean score, in its standard errors", number(z.mean_score)) +
               row("Worst score", number(z.worst_score)) +
               row("at x, y", fmt::format("{}, {}", z.worst_x, z.worst_y)) +
               row("Probability of a worst score so far out", number(z.worst_probability)) +
               row("Values without an error and unequal", fmt::format("{}", z.faults))) +
         "</section>\n";
}

}  // namespace

std::string compare_report_html(const CompareReport& report) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0} against "
      "{1}</title>\n"
      "<style>{2}</style>\n</head>\n<body>\n<header>\n<h1>{0} against {1}</h1>\n</header>\n<main>\n",
      escape_html(report.a), escape_html(report.b), report_style);
  html += figures_table(report);
  if (report.z) html += z_table(*report.z);
  html += figure(report.shown.a, "A: " + report.a, "A: " + report.a);
  html += figure(report.shown.b, "B: " + report.b, "B, the reference: " + report.b);
  html += figure(
      report.difference, "Size of the difference in false colours",
      "|A - B| over the root mean square of B: black 1e-6 or less, white 100 or more, lightness by the "
      "logarithm.");
  html += figure(perceptual_map_image(report.perceptual.map), "Perceptual difference in false colours",
                 "How different they look when one is flipped with the other (after FLIP, Andersson et al. "
                 "2020): black 0, "
                 "yellow-white 1.");
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace welkin
