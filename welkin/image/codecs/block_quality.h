#pragma once

namespace welkin {

/// How long an encoder of blocks may search; see docs/compression.md for what each setting costs and gives.
enum class BlockQuality { fast, normal, high };

}  // namespace welkin
