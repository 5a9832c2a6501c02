// What headers say about a subject and its baseline: which laws are meant for it, and what the two share.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/trace/trace_header.hpp"

namespace broadside::validation {

// "the trace records no contacts" for the first of these groups that the header lacks; empty when it has all.
std::string lacking(const core::TraceHeader& header, std::uint32_t groups);

bool has(const core::TraceHeader& header, core::Group group);

// The share of a depth that a step corrects, as declared; 0 where no correction is declared.
double correction_rate(const core::TraceHeader& header);

// Whether points of contact are recorded with the impulses that acted there, and not as places alone.
bool has_impulses(const core::TraceHeader& header);

// Why impulses of points cannot be judged; empty when they can.
std::string lacking_impulses(const core::TraceHeader& header);

// Value of one key in the stamp's canonical settings "a=1,b=2"; empty when it is not there.
std::string_view setting(const core::Stamp& stamp, std::string_view key);

// Whether both have the same settings, apart from these keys. For two runs of one engine every key must be equal. Twins
// may have keys of their own, such as a device's; then only keys that both have are compared.
bool same_settings_but(const core::Stamp& a, const core::Stamp& b, std::initializer_list<std::string_view> but);

// Whether the trace is of an engine that moved the bodies itself: it has states, or digests alone, and was not fed.
bool moves_bodies(const core::TraceHeader& header);

// Both are of one engine; or one engine declares itself the twin of the other; or both are twins of a third one.
bool are_twins(const core::TraceHeader& a, const core::TraceHeader& b);

// Why the laws of METHOD do not hold for this engine; empty when it declares that it follows METHOD.
std::string why_not_method(const core::TraceHeader& header);

}  // namespace broadside::validation
