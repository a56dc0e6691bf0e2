# Sourced by the scripts that prove things on a bare Debian 12: bootstraps one into $folder, which is removed at the end
# unless the caller named it, and runs commands there. Needs root, debootstrap and the machine's own Debian mirror.

fail() { echo "error: $1" >&2; exit 2; }

# prepare_folder [FOLDER]
prepare_folder() {
  ((EUID == 0)) || fail "needs root, for debootstrap and chroot"
  command -v debootstrap >/dev/null || fail "debootstrap is missing; apt-get install debootstrap"
  keep=yes folder=${1:-}
  if [[ -z $folder ]]; then
    folder=$(mktemp -d)
    keep=no
  fi
  trap clean_up EXIT
}

clean_up() {
  local mounted
  for mounted in dev/pts proc; do
    if mountpoint -q "$folder/$mounted"; then umount "$folder/$mounted"; fi
  done
  [[ $keep == yes ]] || rm -rf --one-file-system "$folder"
}

# The Debian mirror that this machine's apt takes packages from: "URIs:" of the newer format, else the first "deb" line
# of the older.
mirror() {
  local found
  found=$(sed -n 's/^URIs: *\([^ ]*\/debian\/\{0,1\}\)$/\1/p' /etc/apt/sources.list.d/*.sources 2>/dev/null | head -n 1)
  [[ -n $found ]] || found=$(sed -n 's/^deb *\(\[[^]]*\] *\)\{0,1\}\([^ ]*\/debian\/\{0,1\}\) .*/\2/p' /etc/apt/sources.list \
    /etc/apt/sources.list.d/*.list 2>/dev/null | head -n 1)
  [[ -n $found ]] || fail "no Debian mirror among the sources of this machine's apt"
  echo "$found"
}

# Proxy, clock and certificate settings of this machine, so that the new Debian reaches the mirror as this one does.
copy_network_settings() {
  local settings
  while read -r settings; do
    cp "$settings" "$folder/etc/apt/apt.conf.d/"
  done < <(grep -lE 'Proxy|Check-Valid-Until|Check-Date|CaInfo' /etc/apt/apt.conf /etc/apt/apt.conf.d/* 2>/dev/null)
  cp /etc/resolv.conf "$folder/etc/resolv.conf"
  if [[ -d /etc/ssl/certs ]]; then
    mkdir -p "$folder/etc/ssl"
    cp -rL /etc/ssl/certs "$folder/etc/ssl/" 2>/dev/null || true
  fi
}

bare_debian() {
  debootstrap --variant=minbase bookworm "$folder" "$(mirror)" >/dev/null
  copy_network_settings
  mount -t proc proc "$folder/proc"
  # as every installed Debian has it: a browser's driver is spoken to at localhost
  echo "127.0.0.1 localhost" >"$folder/etc/hosts"
  # terminals, which some tests open
  mount -t devpts -o newinstance,ptmxmode=0666 devpts "$folder/dev/pts"
  ln -sf pts/ptmx "$folder/dev/ptmx"
}

# timed NAME COMMAND...: runs it and says what came out and how long it took.
timed() {
  local name=$1 start=$SECONDS status=0
  shift
  echo "== $name"
  "$@" || status=$?
  echo "== $name: exit $status after $((SECONDS - start)) s"
  ((status == 0)) || exit "$status"
}

# inside PLACE COMMAND: with a login's worth of environment and nothing of ours.
inside() {
  chroot "$folder" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin ${http_proxy:+http_proxy="$http_proxy"} \
    ${https_proxy:+https_proxy="$https_proxy"} bash -c "cd $1 && $2"
}
