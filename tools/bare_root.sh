#!/usr/bin/env bash
# Runs a command on a copy of this repository in a bare Debian: nothing that this machine has installed counts there.
#   tools/bare_root.sh bookworm|trixie[-arm64] DIR [COMMAND...]   e.g. tools/bare_root.sh bookworm /var/tmp/bare ./run.sh
# -arm64: of another processor, whose programs the kernel starts by qemu (tools/try_release.sh).
# DIR is new or empty, and becomes a root of debootstrap's smallest kind; or one that this tool made before: what was
# installed and built there stays. The copy, /root/roboss in DIR, has all files that git lists or does not ignore, as
# they are on disk now, with uncommitted changes and without .git. Without COMMAND, only the root and the copy are made.
# The root gets the apt sources of its release, name servers, certificates, proxies and registries of this machine.
# Mounts and processes live in namespaces of their own, so they end with the command, or when this script is killed;
# DIR stays. Exit codes: that of COMMAND; 2 for wrong arguments; 3 if there can be no root, with the reason.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
marker=etc/roboss_bare_root
copy=root/roboss
certificates=etc/ssl/certificates_of_the_host.crt  # a path that no package writes to
needed_mib=6000                                    # packages and one build with tests

fail() {
    local code=$1
    shift
    printf 'bare_root: %s\n' "$@" >&2
    exit "$code"
}

check_arguments() {
    local usage="usage: tools/bare_root.sh bookworm|trixie[-arm64] DIR [COMMAND...]"
    [[ $release =~ ^(bookworm|trixie)(-arm64)?$ ]] || fail 2 "no release '$release'" "$usage"
    [[ -n $root ]] || fail 2 "no folder for the root" "$usage"
    if [[ -e $root/$marker ]]; then
        [[ $(<"$root/$marker") == "$release" ]] || fail 2 "$root is a root of $(<"$root/$marker"), not of $release" \
            "remedy: name another folder, or remove this one"
    elif [[ -e $root ]]; then
        [[ -d $root ]] || fail 2 "$root is no folder" "remedy: name a folder that is new or empty"
        [[ -z $(ls -A "$root") ]] || fail 2 "$root is not empty and was not made by this tool (or not to its end)" \
            "remedy: name a folder that is new or empty, or remove this one"
    fi
}

# What a root needs of this machine; the mounts are tried for themselves.
check_machine() {
    local free
    [[ $(id -u) == 0 ]] || fail 3 "this user is not root, and only root may mount and change the root folder" \
        "remedy: sudo $0 $release $root ..."
    command -v debootstrap >/dev/null || "$here/setup.sh" root || fail 3 "debootstrap is missing" \
        "remedy: as root, apt-get install debootstrap"
    unshare --mount --pid --fork true 2>/dev/null || fail 3 "this machine allows no mount namespace" \
        "remedy: in a container, start it with --privileged"
    [[ $release != *-arm64 || $(uname -m) == aarch64 ]] || grep -qs '^flags:.*F' /proc/sys/fs/binfmt_misc/qemu-aarch64 ||
        fail 3 "the kernel of this machine starts no programs of arm64" \
            "remedy: as root, apt-get install qemu-user-static binfmt-support"
    mkdir -p "$root" || fail 3 "cannot make $root" "remedy: name a folder where root may write"
    free=$(df --output=avail -m "$root" | tail -1)
    [[ -e $root/$marker || $free -ge $needed_mib ]] || fail 3 "$root has $free MiB free, $needed_mib are needed" \
        "remedy: name a folder on another disk"
}

make_root() {
    local log mirror keys=/usr/share/keyrings/debian-archive-keyring.gpg
    local options=(--variant=minbase --keyring="$keys")
    [[ $release != *-arm64 ]] || options+=(--arch=arm64)
    mirror=$("$here/debian_archives.sh" "${release%-arm64}" | sed -n '1s/ .*//p')
    [[ -f $keys ]] || fail 3 "the keys of Debian's archive are missing ($keys)" \
        "remedy: as root, apt-get install debian-archive-keyring"
    printf 'bare_root: a root of %s in %s, from %s\n' "$release" "$root" "$mirror"
    log=$(mktemp)
    if ! debootstrap "${options[@]}" "${release%-arm64}" "$root" "$mirror" >"$log" 2>&1; then
        tail -5 "$log" >&2
        ! grep -q '^E: Release signed by unknown key' "$log" || fail 3 "$keys has no key of $release" \
            "remedy: as root, apt-get install a newer debian-archive-keyring; then remove $root and try again"
        fail 3 "debootstrap failed (its last lines are above)" \
            "remedy: no network? no such release at $mirror? Then remove $root and try again"
    fi
    rm -f "$log"
    # dpkg need not wait for the disk at each file: a root that a power cut spoils is made again.
    mkdir -p "$root/etc/dpkg/dpkg.cfg.d"
    printf 'force-unsafe-io\n' >"$root/etc/dpkg/dpkg.cfg.d/90host"
    printf '%s\n' "$release" >"$root/$marker"
}

# keep FILE...: copies those that this machine has to the same place in the root.
keep() {
    local file
    for file in "$@"; do
        [[ -f $file ]] || continue
        mkdir -p "$root/$(dirname "$file")"
        cp --preserve=mode "$(readlink -f "$file")" "$root/$file"
    done
}

# How this machine reaches the network: names, apt, certificates, pip, npm, cargo.
copy_settings() {
    local bundle=${SSL_CERT_FILE:-/etc/ssl/certs/ca-certificates.crt}
    keep /etc/hosts /etc/resolv.conf /etc/hostname
    "$here/debian_archives.sh" "${release%-arm64}" | sed 's/^/deb /; s/$/ main/' >"$root/etc/apt/sources.list"
    keep /etc/apt/auth.conf /etc/apt/auth.conf.d/*.conf /etc/netrc
    { apt-config dump 2>/dev/null || true; } | grep -iv 'auto-detect' | grep -iE \
        '^Acquire::(https?|ftp|Retries|Check-Valid-Until|Check-Date|ForceIPv[46]|Languages)' \
        >"$root/etc/apt/apt.conf.d/90host" || true
    keep /etc/pip.conf ~/.pip/pip.conf ~/.config/pip/pip.conf ~/.npmrc /etc/npmrc /usr/etc/npmrc /usr/local/etc/npmrc \
        ~/.cargo/config.toml
    [[ -f $bundle ]] || return 0
    mkdir -p "$root/${certificates%/*}"
    cp "$bundle" "$root/$certificates"
    printf 'Acquire::https::CAInfo "/%s";\n' "$certificates" >>"$root/etc/apt/apt.conf.d/90host"
    keep /etc/ssl/certs/ca-certificates.crt /usr/local/share/ca-certificates/*.crt
}

# fingerprints FOLDER <NAMES: a record for the content of each file, and one for its mode.
fingerprints() {
    local names
    names=$(mktemp)
    cat >"$names"
    (cd "$1" && { xargs -0 sha256sum --zero -- <"$names" || true; xargs -0 stat --printf='%064f  %n\0' -- <"$names" || true; }) 2>/dev/null
    rm -f "$names"
}

# The files that git lists or does not ignore; those of an earlier copy that are gone since are removed. Those that changed
# are as new as this copy: an object that was built of an earlier one, after the change, must not count as newer. The
# others keep their time, so that a fresh checkout causes no build.
copy_repository() {
    local list=$root/root/.roboss_files new
    new=$(mktemp)
    git -c safe.directory="*" -C "$here/.." ls-files -z --cached --others --exclude-standard >"$new" || fail 3 "git lists no files here" \
        "remedy: read git's message above; the repository must be a clone"
    mkdir -p "$root/$copy"
    (cd "$here/.." && while IFS= read -r -d '' file; do
        if [[ -e $file || -L $file ]]; then printf '%s\0' "$file"; fi
    done <"$new") | sort -z >"$list.new"
    rm -f "$new"
    if [[ -f $list ]]; then
        comm -z -23 "$list" "$list.new" | (cd "$root/$copy" && xargs -0 --no-run-if-empty rm -f)
    fi
    comm -z -23 <(fingerprints "$here/.." <"$list.new" | sort -z) <(fingerprints "$root/$copy" <"$list.new" | sort -z) |
        cut -z -c 67- | sort -zu |
        tar -C "$here/.." --no-recursion --null -T - -cf - | tar -C "$root/$copy" --no-same-owner --touch -xf -
    mv "$list.new" "$list"
}

# As the first process of the namespaces: the root becomes theirs, and the command runs in it.
inside() {
    mount --bind "$root" "$root"
    cd "$root"
    mount -t proc proc proc
    mount --rbind /sys sys
    mount --rbind /dev dev
    mount -t tmpfs -o mode=1777 tmpfs dev/shm
    mount -t devpts -o newinstance,ptmxmode=0666,mode=620 devpts dev/pts
    mount -t tmpfs -o mode=755 tmpfs run
    local names=(TERM ROBOSS_COMMIT http_proxy https_proxy ftp_proxy all_proxy no_proxy HTTP_PROXY HTTPS_PROXY FTP_PROXY ALL_PROXY NO_PROXY
        PIP_INDEX_URL PIP_EXTRA_INDEX_URL PIP_TRUSTED_HOST PIP_DEFAULT_TIMEOUT npm_config_registry NPM_CONFIG_REGISTRY)
    local name variables=(HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin)
    for name in "${names[@]}"; do
        [[ -z ${!name:-} ]] || variables+=("$name=${!name}")
    done
    if [[ -f $certificates ]]; then
        for name in SSL_CERT_FILE CURL_CA_BUNDLE REQUESTS_CA_BUNDLE PIP_CERT NODE_EXTRA_CA_CERTS CARGO_HTTP_CAINFO GIT_SSL_CAINFO; do
            variables+=("$name=/$certificates")
        done
    fi
    # With pivot_root the root is one like any other: user namespaces and mounts work in it. A machine that starts from
    # memory allows chroot only.
    if pivot_root . . 2>/dev/null; then umount -l .; fi
    chroot . /usr/bin/env -i --default-signal=INT,QUIT --chdir="/$copy" "${variables[@]}" "$@"
}

if [[ ${1:-} == --inside ]]; then
    root=$2
    shift 2
    inside "$@"
    exit  # with the command's code; not the end of the script, so that bash stays as the one that adopts orphans
fi

release=${1:-} root=${2:-}
check_arguments
check_machine
shift 2
root=$(realpath "$root")
[[ -e $root/$marker ]] || make_root
copy_settings
copy_repository
[[ $# -gt 0 ]] || exit 0
# The copy has no .git: its build takes the commit from the environment (src/app/CMakeLists.txt).
ROBOSS_COMMIT=${ROBOSS_COMMIT:-$(git -c safe.directory="*" -C "$here/.." describe --always --dirty --exclude='*' 2>/dev/null || true)}
export ROBOSS_COMMIT
# In the background, for a shell hears signals while it waits, and not before its child ends. unshare itself blocks SIGTERM.
env --default-signal=INT,QUIT setpriv --pdeathsig KILL \
    unshare --mount --propagation private --pid --fork --kill-child=KILL "$BASH" "$here/bare_root.sh" --inside "$root" "$@" <&0 &
child=$!
trap 'kill -KILL "$child"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP
status=0
wait "$child" || status=$?
trap - EXIT
exit "$status"
