#pragma once
#include <welkin/image/codecs/bc6h/search.h>

namespace welkin::bc6h {

/// The best code that the search of this speed finds; see encode_bc6h_block.
Candidate encode(const Targets& targets, Bc6hSpeed speed);

}  // namespace welkin::bc6h
