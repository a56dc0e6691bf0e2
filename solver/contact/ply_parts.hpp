// What PlyContact is made of.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <string>
#include <vector>

#include "solver/contact/ply_contact.hpp"
#include "solver/contact/ply_face.hpp"
#include "solver/contact/ply_law.hpp"
#include "solver/contact/ply_pass.hpp"

namespace weaveform {

struct PlyContact::Parts {
  explicit Parts(Team& its_team) : team(its_team) {}

  struct Pair {
    PairTables tables;
    std::vector<PlyPassState> pass;  // nodes of the lower on the upper, nodes of the upper on the lower
    PairReading reading;
    bool neighbours = false;
    bool pressed = false;  // ever
    bool bounded = false;  // counts for the stable step
    double far = 0.0;      // mm; of a pair asleep: how far the plies' ways may grow until it is looked at again
    [[nodiscard]] bool awake() const { return pass[0].awake(); }
    [[nodiscard]] double thinner(const std::deque<PlyFace>& faces) const {  // mm
      return std::min(faces[reading.lower].touching().thickness, faces[reading.upper].touching().thickness);
    }
  };
  // Blocks of a ply that one thread takes at a time, whatever the number of threads.
  struct Chunk {
    int ply = 0, first_block = 0, end_block = 0;
    std::vector<int> pass;        // of this ply's nodes; 2 * pair + side
    std::vector<PlyReturn> back;  // of each pass
  };

  // Segments of a ply that one thread adds to at a time, and the chunks and passes that give to it.
  struct Part {
    int ply = 0, first_segment = 0, end_segment = 0;
    std::vector<std::array<int, 2>> from;
  };

  [[nodiscard]] PlyPassState& pass(int number) { return pair[number / 2].pass[number % 2]; }
  void make_pair(int lower, int upper, const PairLaw& law, double frequency, std::vector<std::string>& complaints);
  void list_returns();
  void look_at_start(Pair& its, std::vector<std::string>& complaints);
  void sleep_or_wake(Pair& its, double gap);
  void count_ways(double step_made);
  void look_at_sleepers();
  void look(double inverse_time);
  void fold();
  void read(Pair& its) const;

  Team& team;
  std::deque<PlyFace> face;
  std::deque<Pair> pair;
  std::vector<Chunk> chunk;
  std::vector<Part> part;
  bool swollen = false;  // some ply thickens
  bool started = false;
  double time = 0.0;  // s; of the last add_forces
  double wall_s = 0.0;
};

}  // namespace weaveform
