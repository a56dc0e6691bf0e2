#include "app/process.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>

#include "app/console.hpp"

namespace weaveform {
namespace {

void open_standard_files() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // the lowest free number is this one, as those below are open
    const int opened = open("/dev/null", O_RDONLY);
    if (opened >= 0 && opened != descriptor) close(opened);
  }
}

[[noreturn]] void end_with_code() {
  int code = defect_code;
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::exception& error) {
    code = report(error);
  } catch (...) {
    code = defect_code;
  }
  std::_Exit(code);
}

}  // namespace

void prepare_process() {
  open_standard_files();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(end_with_code);
}

}  // namespace weaveform
