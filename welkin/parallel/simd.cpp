#include <welkin/parallel/simd.h>

#include <hwy/highway.h>

#include <cstdint>

#include <welkin/error.h>

namespace welkin {
namespace {

std::int64_t best_targets() {
  hwy::SetSupportedTargetsForTest(0);
  return hwy::SupportedTargets() & HWY_TARGETS;
}

std::vector<std::int64_t> each_of(std::int64_t targets) {
  std::vector<std::int64_t> list;
  for (; targets != 0; targets &= targets - 1) list.push_back(targets & ~(targets - 1));
  return list;
}

void use(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

std::vector<std::string> simd_targets() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    for (std::int64_t target : each_of(best_targets())) found.push_back(hwy::TargetName(target));
    return found;
  }();
  return names;
}

void choose_simd_target(const std::string& name) {
  const std::vector<std::int64_t> targets = each_of(best_targets());
  if (name.empty()) return use(0);
  for (std::int64_t target : targets)
    if (name == hwy::TargetName(target)) return use(target);
  throw Error("no vector instructions \"" + name + "\" here");
}

}  // namespace welkin
