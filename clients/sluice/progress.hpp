#pragma once

#include <chrono>
#include <cstdint>
#include <ostream>
#include <string>

namespace sluice::clients {

// How far a run is.
struct Position {
  double time = 0;      // simulated [s]
  double duration = 0;  // simulated, of the whole run [s]
  std::uint64_t step = 0;
  std::uint64_t steps = 0;  // of the whole run
  double steps_per_second = 0;

  [[nodiscard]] double fraction() const;
};

// "0:07", "12:34", "3:04:05"; "-:--" when it is not known.
std::string clock_text(double seconds);
// "[=====>    ]  52.0 %  t = 0.1560 / 0.3000 s  1234 steps/s  ETA 0:07", `columns` wide at the most.
std::string bar_line(const Position& position, std::size_t columns);
std::string plain_line(const Position& position);

// Decides when the next plain line is due: at each tenth of the run, but never two within two seconds, and
// once a minute when tenths are far apart.
class LineRhythm {
 public:
  using Instant = std::chrono::steady_clock::time_point;
  bool due(double fraction, Instant now);

 private:
  Instant last_{};
  int tenths_ = -1;
};

// Shows a run's progress: a bar that is redrawn on a terminal, lines now and then elsewhere.
class Progress {
 public:
  Progress(std::ostream& out, bool terminal, std::size_t columns)
      : out_(out), terminal_(terminal), columns_(columns) {}
  void show(const Position& position);
  // Removes the bar, so that other text can be written.
  void clear();

 private:
  std::ostream& out_;
  bool terminal_;
  std::size_t columns_;
  LineRhythm rhythm_;
};

}  // namespace sluice::clients
