#include "core/instructions/choose_loops.hpp"
#include "solver/contact/chord_kernel.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(ChordLoops, chord_loops)

void chord_turns(const ChordLattice& lattice, int first, int count, unsigned wanted, ChordTurns& turns) {
  chosen_chord_loops().chord_turns(lattice, first, count, wanted, turns);
}

void chord_terms(const ChordTurns& turns, const double* const (&length)[2], int count, const ContactGroups& groups,
                 double friction, double part, Distances& distances, ChordTerms& terms) {
  chosen_chord_loops().chord_terms(turns, length, count, groups, friction, part, distances, terms);
}

ContactSums chord_forces(const ContactLaw& law, const ContactTool& tool, const Distances& distances,
                         const ChordTerms& terms, double time, const ContactNodes& nodes, const ContactGroups& groups,
                         const ChordMemory& memory) {
  return chosen_chord_loops().chord_forces(law, tool, distances, terms, time, nodes, groups, memory);
}

}  // namespace weaveform
