#pragma once
#include "reflect_methods.h"

// Filtered maps of lobes: Kautz & McCool 2000, McAllister et al. 2002.

namespace welkin {

PreparedReflection prepare_lobes_method(const ReflectInput& input);
PreparedReflection prepare_two_lobes_method(const ReflectInput& input);
PreparedReflection prepare_published_lobes_method(const ReflectInput& input);
PreparedReflection prepare_single_lobe_method(const ReflectInput& input);
/// Throws Error unless the BRDF is written as lafortune:...
PreparedReflection prepare_lafortune_method(const ReflectInput& input);

}  // namespace welkin
