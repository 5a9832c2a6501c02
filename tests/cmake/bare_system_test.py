"""What cmake/package makes, tried where nothing is installed:  bare_system_test.py BUILD WORK

A bare Debian 12 is made with mmdebstrap, from the archive that this machine has, and kept in WORK for the next time. In copies of it the
demonstration must run, judge and write its page: from the two Debian packages, with an engine built against the second; from
`cmake --install`; from the portable archive, as a user without rights; and from the wheel, where the build tree makes one. The gate's
page is walked through with the packages as well.

Needs root (for chroot), mmdebstrap, and a machine whose programs Debian 12 can run, which is one with Debian 12; otherwise exit code 77.
"""

import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SUITE = "bookworm"
OLDEST_S = 30 * 24 * 3600.0  # a bare system that is kept longer lacks a month of the distribution's corrections
NOBODY = 65534

# The demonstration on its own scenes, shorter: the bunny has a stand-in where no mesh is, and the page says so.
DEMO = """
mkdir -p {at} && cd {at}
{broadside} --version
{broadside} demo --frames 60 --out demo
test -s demo/report.html && test -s demo/junit.xml && test -s demo/octree-cpu.h5 && test -d demo/turning
{broadside} check demo/octree-cpu.h5 >/dev/null
"""
# The page of the gate as a reader walks through it, with git remotes that are folders: its campaign and its two commands, on a push to
# main, then on a change whose sweep ends too early.
PAGE = ROOT / ".github/actions/gate/README.md"
GATE = """
cd /srv && git config --global user.name t && git config --global user.email t@t
git init -q --bare -b main remote.git && git clone -q remote.git user 2>&1 && cd user && git checkout -q -B main
cp /usr/share/broadside/examples/sweep.c . && mv /srv/campaign.toml . && printf 'out/\n*.so\n' >.gitignore
printf 'libmine.so: sweep.c\n\tcc -shared -fPIC -o $@ $<\n' >Makefile
git add -A && git commit -q -m 'An engine' && git push -q origin main && make -s libmine.so
{on_main}
git checkout -q -b faster && sed -i 's/min\[0\] > s->boxes/min[0] + 0.3f > s->boxes/' sweep.c && git commit -q -a -m Faster && make -s libmine.so
code=0; {on_change} >said || code=$?
test $code -eq 1 && grep -q '^::error file=campaign.toml,line=3,title=candidate-set' said && test -s out/gate/report.html
"""
# On a system that starts services, apt-get would start them in the chroot as well: none is wanted.
INSTALL = "export DEBIAN_FRONTEND=noninteractive; apt-get -qq update; apt-get -qq install -y --no-install-recommends "


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def run(command, **more):
    answer = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **more)
    if answer.returncode != 0:
        raise AssertionError(f"exit {answer.returncode}: {command}\n{answer.stdout[-6000:]}")
    return answer.stdout


class System:
    """A copy of the bare system, removed at the end."""

    def __init__(self, work, bare, name):
        self.root = work / name
        self.name = name
        remove(self.root)
        self.root.mkdir(parents=True)
        run(["tar", "-xf", bare, "-C", self.root])
        # The bare system resolves names as this machine does.
        shutil.copy("/etc/resolv.conf", self.root / "etc/resolv.conf")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        remove(self.root)

    def run(self, script, user=0):
        """In a namespace of its own, so that nothing stays mounted whatever happens."""
        began = time.monotonic()
        inside = ["chroot", f"--userspec={user}:{user}", str(self.root), "/bin/sh", "-euc", script]
        text = run(["unshare", "--mount", "--pid", "--fork", f"--mount-proc={self.root}/proc", *inside],
                   env={"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "LC_ALL": "C.UTF-8", "HOME": "/srv"})
        print(f"{self.name}: {time.monotonic() - began:.0f} s: {' '.join(script.split())[:100]}", flush=True)
        return text


def remove(folder):
    if folder.exists():
        subprocess.run(["rm", "-rf", "--one-file-system", folder], check=True)


def bare_system(work):
    tar = work / f"bare-{SUITE}.tar"
    if not tar.exists() or time.time() - tar.stat().st_mtime > OLDEST_S:
        part = tar.with_suffix(".part.tar")
        answer = subprocess.run(["mmdebstrap", "--quiet", "--variant=apt", SUITE, part], stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if answer.returncode != 0:
            skip(f"no bare system could be made: {answer.stdout.strip().splitlines()[-1:]}")
        part.rename(tar)
    return tar


def from_debian_packages(work, bare, packages, build):
    with System(work, bare, "debian-packages") as system:
        for package in packages.glob("*.deb"):
            shutil.copy(package, system.root / "srv")
        system.run(INSTALL + "/srv/broadside_*.deb /srv/broadside-dev_*.deb")
        system.run(DEMO.format(at="/srv/deb", broadside="broadside"))
        system.run(INSTALL + "gcc libc6-dev")
        system.run("cd /srv && cc -shared -fPIC -o libsweep.so /usr/share/broadside/examples/sweep.c && "
                   "broadside pairs boxes:mixed:500 --engine octree-cpu --engine ./libsweep.so")
        system.run(INSTALL + "git python3 make")
        page = PAGE.read_text(encoding="utf-8")
        (system.root / "srv/campaign.toml").write_text(re.search(r"```toml\n(.*?)```", page, re.DOTALL).group(1), encoding="utf-8")
        on_main, on_change = (line.split("#")[0].strip() for line in page.splitlines() if line.startswith("broadside-gate "))
        system.run(GATE.format(on_main=on_main, on_change=on_change))
        from_wheel(system, packages)
        # The packages' dependencies stay; the program itself is now taken from an installed tree.
        system.run("dpkg --purge broadside-dev broadside")
        assert not (system.root / "usr/bin/broadside").exists() and not (system.root / "usr/include/broadside_engine.h").exists()
        run(["cmake", "--install", build, "--prefix", system.root / "usr/local", "--strip"])
        system.run(DEMO.format(at="/srv/tree", broadside="/usr/local/bin/broadside"))


def from_wheel(system, packages):
    """The wheel holds the program and a module; their libraries are those of the Debian package."""
    wheels = list(packages.glob("*.whl"))
    if not wheels:
        print("no wheel: this build tree does not make the Python package")
        return
    shutil.copy(wheels[0], system.root / "srv")
    system.run(INSTALL + "python3-venv python3-numpy")
    system.run("cd /srv && python3 -m venv --system-site-packages venv && "
               f"venv/bin/pip -q install --no-index --no-deps ./{wheels[0].name} && venv/bin/python -c 'import broadside'")
    system.run(DEMO.format(at="/srv/wheel", broadside="/srv/venv/bin/broadside"))


def from_portable_archive(work, bare, packages):
    with System(work, bare, "portable") as system:
        archive, = packages.glob("*.tar.gz")
        place = system.root / "srv/portable"
        place.mkdir()
        run(["tar", "-xf", archive, "-C", place, "--strip-components=1"])
        run(["chown", "-R", f"{NOBODY}:{NOBODY}", system.root / "srv"])
        system.run(DEMO.format(at="/srv/out", broadside="/srv/portable/broadside"), user=NOBODY)
        assert (place / "LICENSE").exists() and any((place / "licenses").iterdir())


def main(build, work):
    if os.geteuid() != 0:
        skip("chroot needs root")
    for tool in ("mmdebstrap", "unshare", "chroot", "dpkg-shlibdeps"):
        if shutil.which(tool) is None:
            skip(f"{tool} is not installed")
    if "VERSION_CODENAME=bookworm" not in Path("/etc/os-release").read_text(encoding="utf-8"):
        skip("what is built here needs the libraries of another distribution than Debian 12")
    work.mkdir(parents=True, exist_ok=True)
    bare = bare_system(work)
    packages = work / "packages"
    remove(packages)
    print(run([ROOT / "cmake/package", build, packages]))
    run(["sha256sum", "--check", "--quiet", "SHA256SUMS"], cwd=packages)
    from_portable_archive(work, bare, packages)
    from_debian_packages(work, bare, packages, build)
    print("each form ran where nothing else was installed")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
