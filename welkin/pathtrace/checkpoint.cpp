#include <welkin/pathtrace/checkpoint.h>

#include <bit>
#include <cstring>
#include <string>

#include <welkin/error.h>
#include <welkin/pathtrace/fingerprint.h>

// Layout: Header, then the arrays of PictureState in the order of for_each_array, then content_hash of all before it.

namespace welkin {
namespace {

static_assert(std::endian::native == std::endian::little);

struct Header {
  char magic[8] = {'w', 'e', 'l', 'k', 'i', 'n', 'R', '1'};
  std::int32_t width = 0, height = 0;
  std::uint64_t fingerprint = 0, faults = 0;
};
static_assert(sizeof(Header) == 32);

template <class State, class Visit>
void for_each_array(State& state, const Visit& visit) {
  visit(state.count);
  visit(state.goal);
  visit(state.radiance_sum);
  visit(state.replicate_sum);
  visit(state.albedo_sum);
  visit(state.normal_sum);
  visit(state.depth_sum);
  visit(state.coverage_sum);
}

template <class State>
std::size_t array_bytes(State& state) {
  std::size_t bytes = 0;
  for_each_array(state, [&](auto& values) { bytes += values.size() * sizeof(values[0]); });
  return bytes;
}

Header checked_header(std::span<const std::uint8_t> bytes, std::string_view name, PictureSize size,
                      std::uint64_t fingerprint) {
  Header header;
  const Header wanted;
  if (bytes.size() < sizeof header || std::memcmp(bytes.data(), wanted.magic, sizeof wanted.magic) != 0)
    throw Error(name, "is no state of a picture that this program could go on with");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.width != size.width || header.height != size.height)
    throw Error(name, "is the state of a picture of " + std::to_string(header.width) + " x " +
                          std::to_string(header.height) + ", not of " + std::to_string(size.width) + " x " +
                          std::to_string(size.height));
  if (header.fingerprint != fingerprint)
    throw Error(name,
                "belongs to another scene, environment, camera or set of options; start again without it");
  return header;
}

}  // namespace

std::vector<std::uint8_t> encode_checkpoint(const PictureState& state, std::uint64_t fingerprint) {
  Header header;
  header.width = state.size.width;
  header.height = state.size.height;
  header.fingerprint = fingerprint;
  header.faults = state.faults;
  std::vector<std::uint8_t> bytes(sizeof header + array_bytes(state) + sizeof(std::uint64_t));
  std::memcpy(bytes.data(), &header, sizeof header);
  std::uint8_t* to = bytes.data() + sizeof header;
  for_each_array(state, [&](const auto& values) {
    std::memcpy(to, values.data(), values.size() * sizeof(values[0]));
    to += values.size() * sizeof(values[0]);
  });
  const std::uint64_t checksum = content_hash(std::span(bytes).first(bytes.size() - sizeof(std::uint64_t)));
  std::memcpy(to, &checksum, sizeof checksum);
  return bytes;
}

PictureState decode_checkpoint(std::span<const std::uint8_t> bytes, std::string_view name, PictureSize size,
                               std::uint64_t fingerprint) {
  const Header header = checked_header(bytes, name, size, fingerprint);
  PictureState state = make_picture_state(size);
  if (bytes.size() != sizeof header + array_bytes(state) + sizeof(std::uint64_t))
    throw Error(name, "is cut off or damaged; start again without it");
  std::uint64_t checksum = 0;
  std::memcpy(&checksum, bytes.last(sizeof checksum).data(), sizeof checksum);
  if (checksum != content_hash(bytes.first(bytes.size() - sizeof checksum)))
    throw Error(name, "is damaged; start again without it");
  const std::uint8_t* from = bytes.data() + sizeof header;
  for_each_array(state, [&](auto& values) {
    std::memcpy(values.data(), from, values.size() * sizeof(values[0]));
    from += values.size() * sizeof(values[0]);
  });
  state.faults = header.faults;
  return state;
}

}  // namespace welkin
