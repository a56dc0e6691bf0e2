#include "core/guard/confine.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace weaveform {

#if defined(__x86_64__) || defined(__aarch64__)

namespace {

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#else
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#endif

constexpr std::uint32_t allow = SECCOMP_RET_ALLOW;
constexpr std::uint32_t refuse = SECCOMP_RET_ERRNO | EPERM;
// "no such call": the C library then takes an older one, whose arguments a filter can see
constexpr std::uint32_t unknown = SECCOMP_RET_ERRNO | ENOSYS;
constexpr std::uint32_t other_numbers = 0x40000000;  // x32's calls on x86-64

using Program = std::vector<sock_filter>;

void statement(Program& program, int code, std::uint32_t value) {
  program.push_back({static_cast<std::uint16_t>(code), 0, 0, value});
}
void jump(Program& program, int code, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false) {
  program.push_back({static_cast<std::uint16_t>(code), if_true, if_false, value});
}
void load(Program& program, std::size_t offset) {
  statement(program, BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}
// The lower half of an argument: flags and process numbers fit in it.
void load_argument(Program& program, std::size_t number) {
  load(program, offsetof(seccomp_data, args) + 8 * number);
}
void answer(Program& program, long call, std::uint32_t what) {
  jump(program, BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1);
  statement(program, BPF_RET | BPF_K, what);
}
// Allowed only without any of `bits` in that argument.
void answer_by_bits(Program& program, long call, std::size_t argument, std::uint32_t bits) {
  jump(program, BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 4);
  load_argument(program, argument);
  jump(program, BPF_JMP | BPF_JSET | BPF_K, bits, 0, 1);
  statement(program, BPF_RET | BPF_K, refuse);
  statement(program, BPF_RET | BPF_K, allow);
}
// Allowed only with that value, or that bit, in the first argument.
void answer_unless(Program& program, long call, int test, std::uint32_t value) {
  jump(program, BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 4);
  load_argument(program, 0);
  jump(program, BPF_JMP | test | BPF_K, value, 1, 0);
  statement(program, BPF_RET | BPF_K, refuse);
  statement(program, BPF_RET | BPF_K, allow);
}

// clang-format off
const std::vector<long>& refused_calls() {
  static const std::vector<long> calls = {
      SYS_execve, SYS_execveat, SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_pidfd_send_signal,
      SYS_unlinkat, SYS_renameat, SYS_renameat2, SYS_mkdirat, SYS_mknodat, SYS_linkat, SYS_symlinkat, SYS_fchmod,
      SYS_fchmodat, SYS_fchown, SYS_fchownat, SYS_truncate, SYS_ftruncate, SYS_fallocate, SYS_utimensat, SYS_setxattr,
      SYS_lsetxattr, SYS_fsetxattr, SYS_removexattr, SYS_lremovexattr, SYS_fremovexattr, SYS_socket, SYS_socketpair,
      SYS_connect, SYS_bind, SYS_listen, SYS_mount, SYS_umount2, SYS_pivot_root, SYS_chroot, SYS_setns, SYS_unshare,
      SYS_bpf, SYS_perf_event_open, SYS_userfaultfd, SYS_keyctl, SYS_add_key, SYS_request_key, SYS_init_module,
      SYS_finit_module, SYS_delete_module, SYS_kexec_load, SYS_reboot, SYS_swapon, SYS_swapoff, SYS_acct, SYS_quotactl,
      SYS_open_by_handle_at, SYS_io_setup, SYS_io_submit, SYS_rt_sigqueueinfo, SYS_rt_tgsigqueueinfo, SYS_shmget,
      SYS_msgget, SYS_semget, SYS_mq_open,
#if defined(__x86_64__)
      SYS_fork, SYS_vfork, SYS_creat, SYS_unlink, SYS_rename, SYS_mkdir, SYS_rmdir, SYS_mknod, SYS_link, SYS_symlink,
      SYS_chmod, SYS_chown, SYS_lchown, SYS_utime, SYS_utimes, SYS_futimesat,
#endif
  };
  return calls;
}
// clang-format on

Program filter(bool may_write) {
  Program program;
  load(program, offsetof(seccomp_data, arch));
  jump(program, BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0);
  statement(program, BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
  load(program, offsetof(seccomp_data, nr));
#if defined(__x86_64__)
  jump(program, BPF_JMP | BPF_JGE | BPF_K, other_numbers, 0, 1);
  statement(program, BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
#endif
  for (const long call : refused_calls()) answer(program, call, refuse);
  for (const long call : {SYS_clone3, SYS_openat2, SYS_io_uring_setup, SYS_io_uring_enter, SYS_io_uring_register})
    answer(program, call, unknown);
  constexpr auto writing = static_cast<std::uint32_t>(O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | __O_TMPFILE);
  if (!may_write) {
#if defined(__x86_64__)
    answer_by_bits(program, SYS_open, 1, writing);
#endif
    answer_by_bits(program, SYS_openat, 2, writing);
  }
  answer_unless(program, SYS_clone, BPF_JSET, CLONE_THREAD);
  const auto own = static_cast<std::uint32_t>(getpid());
  for (const long call : {SYS_kill, SYS_tgkill, SYS_tkill}) answer_unless(program, call, BPF_JEQ, own);
  statement(program, BPF_RET | BPF_K, allow);
  return program;
}

void write_only_in(const std::filesystem::path& folder) {
  landlock_ruleset_attr handled{};
  handled.handled_access_fs = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG |
                              LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_SYM |
                              LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR;
  const auto rules = static_cast<int>(syscall(SYS_landlock_create_ruleset, &handled, sizeof handled, 0));
  if (rules < 0) return;
  landlock_path_beneath_attr beneath{};
  beneath.allowed_access = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG;
  beneath.parent_fd = open(folder.c_str(), O_PATH | O_CLOEXEC);
  syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0);
  syscall(SYS_landlock_restrict_self, rules, 0);
  close(beneath.parent_fd);
  close(rules);
}

}  // namespace

bool confine_process(const std::filesystem::path& writable_folder) {
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  if (!writable_folder.empty()) write_only_in(writable_folder);
  Program program = filter(!writable_folder.empty());
  const sock_fprog whole = {static_cast<unsigned short>(program.size()), program.data()};
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &whole) == 0;
}

#else

bool confine_process(const std::filesystem::path&) {
  return false;
}

#endif

}  // namespace weaveform
