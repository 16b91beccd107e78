#include <welkin/envmap/reflection/simplex_search.h>

#include <algorithm>
#include <cassert>

namespace welkin {
namespace {

// The corners in ascending order of their values, so that the last one is the one to move.
class Simplex {
 public:
  Simplex(const std::function<double(std::span<const double>)>& function, std::span<const double> start,
          std::span<const double> step)
      : function_(function) {
    corners_.push_back(evaluated({start.begin(), start.end()}));
    for (std::size_t i = 0; i < start.size(); ++i) {
      std::vector<double> point(start.begin(), start.end());
      point[i] += step[i];
      corners_.push_back(evaluated(std::move(point)));
    }
    sort();
  }

  void advance() {
    const SimplexMinimum mirrored = moved(-1);
    if (mirrored.value < corners_.front().value) {
      const SimplexMinimum further = moved(-2);
      corners_.back() = further.value < mirrored.value ? further : mirrored;
    } else if (mirrored.value < corners_[corners_.size() - 2].value) {
      corners_.back() = mirrored;
    } else {
      const SimplexMinimum nearer = moved(mirrored.value < corners_.back().value ? -0.5 : 0.5);
      if (nearer.value < std::min(mirrored.value, corners_.back().value))
        corners_.back() = nearer;
      else
        shrink();
    }
    sort();
  }

  const SimplexMinimum& best() const { return corners_.front(); }

 private:
  SimplexMinimum evaluated(std::vector<double> point) const {
    const double value = function_(point);
    return {std::move(point), value};
  }

  // The worst corner moved to `share` of its distance from the centre of the others.
  SimplexMinimum moved(double share) const {
    const std::size_t variables = corners_.size() - 1;
    std::vector<double> point(variables);
    for (std::size_t k = 0; k < variables; ++k) {
      double centre = 0;
      for (std::size_t i = 0; i < variables; ++i)
        centre += corners_[i].point[k] / static_cast<double>(variables);
      point[k] = centre + share * (corners_.back().point[k] - centre);
    }
    return evaluated(std::move(point));
  }

  void shrink() {
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      std::vector<double> point = corners_[i].point;
      for (std::size_t k = 0; k < point.size(); ++k) point[k] = 0.5 * (point[k] + corners_[0].point[k]);
      corners_[i] = evaluated(std::move(point));
    }
  }

  void sort() {
    std::stable_sort(corners_.begin(), corners_.end(),
                     [](const SimplexMinimum& a, const SimplexMinimum& b) { return a.value < b.value; });
  }

  const std::function<double(std::span<const double>)>& function_;
  std::vector<SimplexMinimum> corners_;
};

}  // namespace

SimplexMinimum simplex_search(const std::function<double(std::span<const double>)>& function,
                              std::span<const double> start, std::span<const double> step, int iterations) {
  assert(start.size() == step.size() && !start.empty());
  Simplex simplex(function, start, step);
  for (int i = 0; i < iterations; ++i) simplex.advance();
  return simplex.best();
}

}  // namespace welkin
