// The player's own time, and the events that it passes.
//
// An event at clip time e happens at s = e + n d in lap n, d the duration, n = 0 for Once. With s(t) the clip
// time as if the clip went on for ever, the last lap in which e has happened by t is floor((s(t) - e) / d),
// forwards, and the first is ceil((s(t) - e) / d), backwards. Both ends of an advance are judged alike, so
// between two advances nothing is lost or told twice, however s(t) rounds.
#include <cmath>
#include <tuple>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/player_impl.hpp>

namespace pantin {
namespace {

/// Passes the events of one play between two times.
class EventPass {
 public:
  EventPass(const Play& play, double before, double after, std::vector<PlayedEvent>& out)
      : play_{play},
        before_{before},
        after_{after},
        from_{play.clock.read(before, KeySide::After)},
        to_{play.clock.read(after, KeySide::After)},
        out_{out} {}

  void run() const {
    if (play_.clock.speed() == 0) return;
    const std::vector<ClipEvent>& events = play_.clip.clip().events;
    for (std::size_t i = 0; i < events.size(); ++i) {
      const double e = events[i].time;
      if (is_forward()) {
        double first = laps_begun(from_, e) + 1;
        if (play_.is_new && is_at(from_, e, first - 1) && !is_end_of_lap(e)) --first;
        for (double lap = first; lap <= laps_begun(to_, e); ++lap) tell(i, lap);
      } else {
        double last = laps_left(from_, e) - 1;
        if (play_.is_new && is_at(from_, e, last + 1) && !is_start_of_lap(e)) ++last;
        for (double lap = last; lap >= laps_left(to_, e); --lap) tell(i, lap);
      }
    }
  }

 private:
  [[nodiscard]] bool is_forward() const { return play_.clock.speed() > 0; }
  [[nodiscard]] double duration() const { return play_.clock.duration(); }
  /// Number of the last lap in which e has happened, going forwards.
  [[nodiscard]] double laps_begun(const ClockReading& at, double e) const {
    if (!play_.clock.wraps()) return at.unwrapped + at.slack >= e ? 0 : -1;
    return std::floor((at.unwrapped + at.slack - e) / duration());
  }
  /// Number of the last lap in which e has happened, going backwards: laps count down.
  [[nodiscard]] double laps_left(const ClockReading& at, double e) const {
    if (!play_.clock.wraps()) return at.unwrapped - at.slack <= e ? 0 : 1;
    return std::ceil((at.unwrapped - at.slack - e) / duration());
  }
  [[nodiscard]] bool is_at(const ClockReading& at, double e, double lap) const {
    return std::abs(at.unwrapped - (e + lap * duration())) <= at.slack;
  }
  // A play that begins at a seam has not been through the lap before it.
  [[nodiscard]] bool is_end_of_lap(double e) const { return play_.clock.wraps() && e == duration(); }
  [[nodiscard]] bool is_start_of_lap(double e) const { return play_.clock.wraps() && e == 0; }

  void tell(std::size_t index, double lap) const {
    const double e = play_.clip.clip().events[index].time;
    const double passed = play_.clock.play_time(e + lap * duration());
    PlayedEvent event{.play = play_.id, .index = index, .lap = lap, .is_backwards = !is_forward()};
    event.time = std::clamp(passed, before_, after_);
    event.weight = sample(play_.settings.weight, event.time).value;
    out_.push_back(event);
  }

  const Play& play_;
  double before_, after_;
  ClockReading from_, to_;
  std::vector<PlayedEvent>& out_;
};

bool comes_before(const PlayedEvent& a, const PlayedEvent& b) {
  if (a.time != b.time || a.play != b.play) return std::tie(a.time, a.play) < std::tie(b.time, b.play);
  const bool is_first = std::tie(a.lap, a.index) < std::tie(b.lap, b.index);
  const bool is_last = std::tie(b.lap, b.index) < std::tie(a.lap, a.index);
  return a.is_backwards ? is_last : is_first;
}

}  // namespace

void Player::Impl::pass_events(double before, double after) {
  events.clear();
  for (const std::unique_ptr<Play>& play : plays) {
    if (!play->clip.clip().events.empty()) EventPass{*play, before, after, events}.run();
    play->is_new = false;
  }
  std::sort(events.begin(), events.end(), comes_before);
}

double Player::time() const noexcept { return impl_->time; }
std::span<const PlayedEvent> Player::events() const noexcept { return impl_->events; }

void Player::set_time(double time) {
  PANTIN_EXPECTS(std::isfinite(time), "play time " + std::to_string(time) + " s is not finite");
  impl_->settle_carriers();
  for (Carrier& carrier : impl_->carriers) carrier.anchor = time;
  for (const std::unique_ptr<Play>& play : impl_->plays) play->is_new = true;
  impl_->events.clear();
  impl_->time = time;
}

void Player::advance(double elapsed) {
  PANTIN_EXPECTS(elapsed >= 0, "elapsed time " + std::to_string(elapsed) +
                                   " s is negative; give PlayerSettings a negative speed to play backwards");
  advance_to(impl_->time + elapsed);
}

void Player::advance_to(double time) {
  PANTIN_EXPECTS(std::isfinite(time), "play time " + std::to_string(time) + " s is not finite");
  PANTIN_EXPECTS(time >= impl_->time, "play time " + std::to_string(time) + " s is before the present " +
                                          std::to_string(impl_->time) + " s; set_time goes back");
  impl_->pass_events(impl_->time, time);
  impl_->move_carriers(time);
  impl_->time = time;
}

}  // namespace pantin
