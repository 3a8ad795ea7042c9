"""job.py REPORTS ORDERS alone|job COMMAND...: runs the command in the terminal that standard input is, and reports its process,
each stop and its end by lines on the descriptor REPORTS. job: as a shell does, in a process group of its own; a byte from ORDERS
continues it in the foreground."""
import fcntl
import os
import signal
import sys
import termios

reports, orders, kind, command = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3], sys.argv[4:]
fcntl.ioctl(0, termios.TIOCSCTTY, 0)
signal.signal(signal.SIGTTOU, signal.SIG_IGN)
signal.signal(signal.SIGHUP, signal.SIG_IGN)
child = os.fork()
if child == 0:
    if kind == "job":
        os.setpgid(0, 0)
        os.tcsetpgrp(0, os.getpgrp())
    signal.signal(signal.SIGTTOU, signal.SIG_DFL)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    os.close(reports)
    os.close(orders)
    os.execv(command[0], command)
for number in (signal.SIGINT, signal.SIGQUIT, signal.SIGTERM):
    signal.signal(number, signal.SIG_IGN)
os.write(reports, b"%d\n" % child)
while True:
    _, status = os.waitpid(child, os.WUNTRACED)
    if not os.WIFSTOPPED(status):
        break
    if kind == "job":
        os.tcsetpgrp(0, os.getpgrp())
    os.write(reports, b"stopped\n")
    order = os.read(orders, 1)
    if kind == "job" and order == b"f":
        os.tcsetpgrp(0, child)
    os.kill(child, signal.SIGCONT)
os.write(reports, b"ended %d\n" % (os.WEXITSTATUS(status) if os.WIFEXITED(status) else -os.WTERMSIG(status)))
