"""Nobody is ever locked out: what may happen to the viewer on a console, and what the console is afterwards."""
import re

SCANOUT = """$(ps -o pid,comm | awk '$2 == "scanout" { print $1 }')"""
FIRST = """$(ps -o pid,comm | awk '$2 == "scanout" { print $1; exit }')"""


def check_all(guest, session):
    for check in (killed_by_name, killed_all_at_once, restored_in_time, stopped_and_continued, switched_away_and_back,
                  few_descriptors, plain_user, card_taken_by_another):
        if check is not card_taken_by_another or session.backend == "drm":
            check(guest, session)


def mode(guest):
    """The console's mode, whether its keyboard is on, who switches it."""
    return guest.sh("vm_helper mode /dev/tty1").split()


def wait_for_devices(guest):
    """Until the viewer has its keyboard and its mouse open again: keys pressed earlier go elsewhere."""
    guest.sh(f"until [ $(ls -l /proc/{FIRST}/fd | grep -c input/event) = 2 ]; do usleep 20000; done")


def killed_by_name(guest, session):
    """The guard has a name of its own, so that it lives."""
    for how in ("killall -9 scanout", "kill -9 $(pidof scanout)"):
        viewer = session.view()
        guest.sh(how)
        viewer.exit_status()
        session.console_is_back(f"{how.split()[0]} by name")
        session.check(mode(guest) == ["text", "on", "auto"], f"{how}: nobody is asked about a switch", str(mode(guest)))


def killed_all_at_once(guest, session):
    """Even without the guard there is a way back, from elsewhere."""
    viewer = session.view()
    guest.sh(f"kill -9 $(pidof console-guard) {SCANOUT}")
    viewer.exit_status()
    left = mode(guest)
    session.check(left[:2] == ["graphics", "off"], "with its guard killed, too, the console is left as it was: the next line "
                  "checks something", str(left))
    said = guest.sh("scanout restore 2>&1").strip()
    session.check("it was left in graphics mode" in said, "`scanout restore` tells what it did", said)
    session.console_is_back("scanout restore")
    session.check(mode(guest) == ["text", "on", "auto"], "after scanout restore nothing is left", str(mode(guest)))
    viewer = session.view()
    refused = guest.sh("scanout restore 2>&1 || echo @code $?").strip()
    session.check(re.search(r"\(scanout, process|another scanout", refused) and "@code 5" in refused,
                  "scanout restore leaves a viewer that lives alone", refused)
    guest.key("q")
    viewer.exit_status()


def restored_in_time(guest, session):
    """Within 100 ms of the guest's time, and as long as the kernel itself takes for two changes of the mode."""
    measured = []
    for _ in range(1 if session.backend == "fbdev" else 2):
        viewer = session.view()
        said = guest.sh(f"vm_helper time-to-text /dev/tty1 {FIRST}")
        measured.append(tuple(int(ms) for ms in re.search(r"^(\d+) (\d+)$", said, re.M).groups()))
        if "@exit" not in said:
            viewer.exit_status()
        session.console_is_back("SIGKILL")
    session.check(any(passed <= 100 + 2 * change for passed, change in measured), "after SIGKILL the console is soon text: "
                  f"ms in the guest, ms of a change of the mode {measured}", str(measured))
    session.check(mode(guest) == ["text", "on", "auto"], "after SIGKILL nobody is asked about a switch", str(mode(guest)))


def stopped_and_continued(guest, session):
    viewer = session.view()
    guest.key("ctrl", "z")
    guest.sh(f"until grep -q '^State:.T' /proc/{FIRST}/status; do usleep 10000; done")
    session.text_is_back("Ctrl-Z")
    guest.sh(f"kill -CONT {FIRST}")
    viewer.shown()
    session.shows_first_picture("after SIGCONT")
    wait_for_devices(guest)
    guest.key("q")
    session.check(viewer.exit_status() == 0, "Q ends the viewer after SIGCONT")
    session.console_is_back("SIGCONT and Q")


def switched_away_and_back(guest, session):
    """By the seat server and, where there is none, by the kernel's signals."""
    for name, environment in (("libseat", ""), ("no seat server", "LIBSEAT_BACKEND=none ")):
        guest.sh(f"export {environment}" if environment else "unset LIBSEAT_BACKEND")
        viewer = session.view()
        guest.sh("n=0; while [ $n -lt 12 ]; do chvt 2; [ $((n % 3)) = 0 ] && usleep 30000; chvt 1; n=$((n+1)); done")
        guest.sh("chvt 2")
        guest.sh("chvt 1")
        session.shows_first_picture(f"after switches with {name}")
        wait_for_devices(guest)
        guest.key("q")
        session.check(viewer.exit_status() == 0, f"Q ends the viewer after switches with {name}")
        session.console_is_back(f"switches with {name}")
    guest.sh("unset LIBSEAT_BACKEND")


def few_descriptors(guest, session):
    """Too few files to open: one line and exit code 5, before the console is taken."""
    for limit in (14, 40, 200):
        guest.sh(f"(ulimit -n {limit}; scanout view models/spot/spot.obj --quiet --backend {session.backend}; echo @code $?) "
                 "</dev/tty1 >/tmp/said 2>&1 &")
        if limit == 200:
            guest.sh(f"until [ $(vm_helper mode /dev/tty1 | cut -d ' ' -f 2) = off ]; do usleep 20000; done; kill {FIRST}")
        said = guest.sh("until grep -qs @code /tmp/said; do usleep 20000; done; cat /tmp/said").strip()
        expected = r"@code 0" if limit == 200 else r"scanout: fewer than 64 more files can be open.*\n@code 5"
        session.check(re.fullmatch(expected, said), f"with {limit} descriptors: {said.splitlines()[-1]}", said)
    session.check(mode(guest) == ["text", "on", "auto"], "after few descriptors the console is as before", str(mode(guest)))


def plain_user(guest, session):
    """Without a console of its own, and with the rights on the devices: what is typed is the viewer's alone."""
    guest.sh("echo user:x:1000:1000::/tmp:/bin/sh >>/etc/passwd; echo video:x:44:user >/etc/group; "
             "echo input:x:105:user >>/etc/group; chown 0:44 /dev/dri/* /dev/fb0 2>/dev/null; chmod 660 /dev/dri/* /dev/fb0 2>/dev/null; "
             "chown 0:105 /dev/input/event*; chmod 660 /dev/input/event*")
    guest.sh("chmod 666 /dev/ttyS0")
    guest.sh(f"(setsid su user -c 'scanout view /models/spot/spot.obj --backend {session.backend} --no-times --verbose' "
             "</dev/null >/dev/null 2>/dev/ttyS0; echo @exit $?) &")
    guest.wait(r"^input no seat.*2 devices", 60)
    guest.wait(r"^settled$")
    guest.sh("(head -n 1 </dev/tty1 | sed 's/^/@typed /') &")
    for name in ("left", "equal"):
        guest.key(name)
    guest.wait(r"^action \d+ scale_up$")
    guest.key("q")
    session.check(guest.wait(r"^@exit (\d+)$", 20)[0] == "0", "a plain user without a console quits with Q")
    for name in ("o", "k", "ret"):
        guest.key(name)
    typed = guest.wait(r"^@typed (.*)$", 10)[0]
    session.check(typed == "ok", "no key that a plain user pressed for the viewer reached the console", repr(typed))


def card_taken_by_another(guest, session):
    modes, connectors = guest.sh("scanout view --mode help"), guest.sh("scanout view --connector help")
    session.check("640x480@" in modes and "Virtual-1" in connectors, "modes and connectors are listed by help", modes + connectors)
    guest.sh("vm_helper hold /dev/dri/card0 >/tmp/held 2>&1 & until grep -q held /tmp/held; do usleep 10000; done")
    for backend in ("auto", "fbdev"):
        said = guest.sh(f"scanout view models/spot/spot.obj --backend {backend} </dev/tty1 2>&1 || echo @code $?").strip()
        session.check("@code 5" in said and "(vm_helper, process" in said and "scanout, process" not in said, f"--backend {backend}: who holds the card is said",
                      said)
    guest.sh("killall vm_helper")
