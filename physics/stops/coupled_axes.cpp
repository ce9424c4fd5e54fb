#include <pantin/physics/stops/coupled_axes.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pantin {

namespace {

using Number = std::pair<std::size_t, std::size_t>;  // joint position, which of its numbers

/// A number is ratio times that of its leader, plus offset.
struct Lead {
  Number leader{};
  double ratio{1}, offset{0};
};

Number number_of(const TreeLayout& layout, const CoupledNumber& coupled) {
  const TreeLink& link = layout.links[static_cast<std::size_t>(coupled.link)];
  return {static_cast<std::size_t>(link.joint), coupled.axis};
}

/// Who leads whom, the first coupling counting where there are several.
std::map<Number, Lead> leads_of(const TreeLayout& layout) {
  std::map<Number, Lead> leads;
  for (const Closure& closure : layout.closures) {
    if (closure.coupling < 0) continue;
    const auto& [a, b] = closure.coupled;
    leads.emplace(number_of(layout, b), Lead{number_of(layout, a), -a.factor, closure.offset});
  }
  return leads;
}

/// The leader of all, from a number that is led. Where couplings go round in a circle, any of it.
Lead last_leader(const std::map<Number, Lead>& leads, const Lead& first) {
  Lead lead = first;
  for (std::size_t i = 0; i < leads.size(); ++i) {
    const auto next = leads.find(lead.leader);
    if (next == leads.end()) break;
    lead.offset += lead.ratio * next->second.offset;
    lead.ratio *= next->second.ratio;
    lead.leader = next->second.leader;
  }
  return lead;
}

void gather(JointAxis& leader, const JointAxis& led, const Lead& lead) {
  leader.friction += std::abs(lead.ratio) * led.friction;
  if (lead.ratio == 0 || !led.has_stops()) return;  // what is held in one place meets no stop
  double lower = (led.lower - lead.offset) / lead.ratio, upper = (led.upper - lead.offset) / lead.ratio;
  if (lead.ratio < 0) std::swap(lower, upper);
  lower = std::max(lower, leader.lower), upper = std::min(upper, leader.upper);
  if (lower > upper) return;
  leader.restitution = std::max(leader.restitution, led.restitution);
  leader.lower = lower, leader.upper = upper;
}

}  // namespace

std::vector<std::array<JointAxis, 3>> axes_by_leader(const TreeLayout& layout,
                                                     std::span<const JointDefinition* const> joints) {
  std::vector<std::array<JointAxis, 3>> axes;
  for (const JointDefinition* joint : joints) axes.push_back(joint->axes);
  const std::map<Number, Lead> leads = leads_of(layout);
  for (const auto& [led, first] : leads) {
    const Lead lead = last_leader(leads, first);
    if (lead.leader == led) continue;  // led by itself, round a circle
    const JointAxis own = joints[led.first]->axes[led.second];
    JointAxis& left = axes[led.first][led.second];
    left.lower = -JointAxis::kUnlimited, left.upper = JointAxis::kUnlimited, left.friction = 0;
    gather(axes[lead.leader.first][lead.leader.second], own, lead);
  }
  return axes;
}

}  // namespace pantin
