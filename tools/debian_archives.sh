#!/usr/bin/env bash
# Prints Debian's archives for a release as this machine reaches them, one a line: URI SUITE.
#   tools/debian_archives.sh bookworm|trixie     the first line is the archive of the release itself
# They are those of this machine's own release under the name of the other one; Debian's own address where this machine
# is another distribution.
set -euo pipefail
release=${1:?usage: tools/debian_archives.sh bookworm|trixie}
own=$(. /etc/os-release && printf '%s' "${VERSION_CODENAME:-}")
{ apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' 2>/dev/null || true; } |
    awk -v own="$own" -v release="$release" '
        $3 == "main" && ($2 == own || $2 == own "-updates" || $2 == own "-security") {
            sub(own, release, $2)
            if (!seen[$1 " " $2]++) { if ($2 == release) first = first $1 " " $2 "\n"; else others = others $1 " " $2 "\n" }
        }
        END { printf "%s%s", first == "" ? "http://deb.debian.org/debian " release "\n" : first, others }'
