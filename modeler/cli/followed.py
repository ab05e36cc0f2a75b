"""A command as the child of another program: it ends when that ends, however that came about.

    python -m modeler.cli.followed WORDS...

Its standard input is a pipe that the other program holds open and never writes to: the pipe ends
when that does, killed or not, on every system. The command is then interrupted as by Ctrl-C, so
that nothing half-written is left; what does not heed that is killed, with all that it started.
"""

import _thread
import os
import signal
import sys
import threading
import time

from modeler.cli.thresholds import THRESHOLDS


def _wait_for_parent() -> None:
    """Waits for the end of the other program."""
    while os.read(0, 4096):
        pass
    _send_signal_to_all(signal.SIGINT)
    time.sleep(THRESHOLDS.interrupt_patience)
    _send_signal_to_all(getattr(signal, "SIGKILL", signal.SIGTERM))


def _send_signal_to_all(number: int) -> None:
    """To this process and all that it started."""
    if hasattr(os, "killpg") and os.getpgrp() == os.getpid():
        os.killpg(0, number)
    elif number == signal.SIGINT:
        _thread.interrupt_main()  # on Windows `kill` of oneself knows no interrupts
    else:
        os.kill(os.getpid(), number)


if __name__ == "__main__":
    # A program that was itself started in the background ignores it, and passes that on.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Thread(target=_wait_for_parent, daemon=True).start()

    from modeler.cli import main

    sys.exit(main())
