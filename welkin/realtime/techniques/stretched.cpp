#include <memory>
#include <mutex>

#include <welkin/envmap/reflection/stretched_taps.h>
#include <welkin/realtime/techniques/forward_technique.h>
#include <welkin/realtime/techniques/technique_list.h>

// GGX by three look-ups of the chain that the split sum looks up once (docs/reflection.md).

namespace welkin {
namespace {

bool same(const ChainShape& a, const ChainShape& b) {
  return a.size == b.size && a.levels == b.levels && a.law == b.law;
}

// The fit takes about a second: the last table is kept for whoever asks next.
std::shared_ptr<const StretchedTapsTable> table_for(const ChainShape& shape) {
  static std::mutex mutex;
  static std::shared_ptr<const StretchedTapsTable> last;
  const std::lock_guard lock(mutex);
  if (!last || !same(last->chain, shape))
    last = std::make_shared<StretchedTapsTable>(make_stretched_taps_table(shape));
  return last;
}

class Stretched : public ForwardTechnique {
 public:
  Stretched() : ForwardTechnique("stretched.frag") {}

 private:
  // The table belongs to a shape of the chain, not to an environment.
  void prepare(const Frame& frame, const ParameterValues&) override {
    const GpuEnvironment& maps = frame.environment;
    const ChainShape shape{maps.specular_size, maps.specular_levels, maps.law};
    if (table_ && same(shape_, shape)) return;
    shape_ = shape;
    const auto table = table_for(shape);
    TextureDesc desc;
    desc.format = TexelFormat::rg16f;
    table_ = upload_image(stretched_taps_image(*table), desc, false);
    rows_ = table->roughness_size;
  }

  void bind(const Program& program, const Frame&, const ParameterValues&) override {
    program.set_texture("taps_map", first_technique_unit, GL_TEXTURE_2D, table_);
    program.set("taps_rows", static_cast<float>(rows_));
  }

  ChainShape shape_;
  GlTexture table_;
  int rows_ = 0;
};

constexpr TechniqueInfo table[] = {
    {"stretched",
     "glossy by three look-ups of the GGX-filtered chain, spread in the plane of incidence",
     "welkin, docs/reflection.md",
     Truth::unshadowed,
     {},
     [] { return std::unique_ptr<Technique>(std::make_unique<Stretched>()); },
     nullptr},
};

}  // namespace

std::span<const TechniqueInfo> stretched_techniques() { return table; }

}  // namespace welkin
