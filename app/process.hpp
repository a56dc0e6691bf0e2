// What the process is prepared for before anything else is done.
#pragma once

namespace weaveform {

// Standard input, output and error are open afterwards: a file opened later would otherwise take the number of a closed
// one and receive its text. One that was closed takes no writing, so that an answer which cannot be given is an error.
// A reader that has gone and a file beyond the limit of its size become errors of writing, not signals that end the
// process; and whatever ends it in spite of all (no memory where no exception may pass) does so with one of our exit
// codes.
void prepare_process();

}  // namespace weaveform
