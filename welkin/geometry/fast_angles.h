#pragma once
#include <cmath>

#include <welkin/geometry/vec3f.h>

// Angles in turns (a turn is 2 pi radians) by polynomials, for look-ups by direction: a fraction of the time of
// std::atan2 and std::sin, and what a loop calls vectorises. Coefficients interpolate at Chebyshev's nodes.

namespace welkin {

/// atan2(y, x) / (2 pi) in [-1/2, 1/2]; 0 for (0, 0). Off by less than 1e-7 turns, relatively by less than 3e-7 near 0.
inline float atan2_turns(float y, float x) {
  const float ax = std::fabs(x), ay = std::fabs(y);
  const float high = ax > ay ? ax : ay, low = ax > ay ? ay : ax;
  const float t = low / (high > 0 ? high : 1), q = t * t;
  float p = 0.000440267693f;
  p = p * q - 0.00250370606f;
  p = p * q + 0.00670641109f;
  p = p * q - 0.0118679531f;
  p = p * q + 0.0168996617f;
  p = p * q - 0.022596497f;
  p = p * q + 0.0318180526f;
  p = p * q - 0.0530511756f;
  p = p * q + 0.15915494f;
  float turns = t * p;
  turns = ay > ax ? 0.25f - turns : turns;
  turns = x < 0 ? 0.5f - turns : turns;
  return std::copysign(turns, y);
}

/// x = cos, y = sin of `turns` turns, |turns| < 2^20; off by less than 2e-7, relatively by less than that near their
/// zeros.
inline Vec2f cos_sin_turns(float turns) {
  const float quarters = turns * 4;
  const int quarter = static_cast<int>(quarters + (quarters < 0 ? -0.5f : 0.5f));
  const float r = turns - 0.25f * static_cast<float>(quarter), q = r * r;
  const float sine = r * (6.28318529f + q * (-41.3416626f + q * (81.5925429f + q * -75.4016127f)));
  const float cosine = 1 + q * (-19.7392087f + q * (64.9393161f + q * (-85.4428447f + q * 59.220169f)));
  const bool swap = (quarter & 1) != 0;
  const float a = swap ? sine : cosine, b = swap ? cosine : sine;
  return {((quarter + 1) & 2) != 0 ? -a : a, (quarter & 2) != 0 ? -b : b};
}

}  // namespace welkin
