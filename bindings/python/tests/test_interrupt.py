"""Ctrl-C ends long calls, and other threads of Python go on beside them."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time

import pytest

import closeranks as cr

RUN = "closeranks.Scenario(team={'robots': 100}, start={'kind': 'hexagon', 'spacing_m': 0.6}, duration_s=3000).run(progress=False, record=False)"
SEARCH = "closeranks.robustness(closeranks.graphs.regular(100, 40, seed=1), progress=False)"


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
@pytest.mark.parametrize("call", [RUN, SEARCH])
def test_ctrl_c_ends_a_long_call(call: str) -> None:
    code = f"import closeranks\nprint('begun', flush=True)\n{call}\n"
    # A shell lets what it starts in the background ignore the signal, and that is inherited.
    listens = "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
    words = [sys.executable, "-c", listens + code]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        try:
            assert child.stdout is not None and child.stdout.readline() == "begun\n"
            time.sleep(1.0)
            assert child.poll() is None, "the call is long"
            child.send_signal(signal.SIGINT)
            _, said = child.communicate(timeout=60)
        finally:
            child.kill()
    assert "KeyboardInterrupt" in said


def test_other_threads_go_on() -> None:
    counted, over = [0], threading.Event()

    def count() -> None:
        while not over.is_set():
            counted[0] += 1
            time.sleep(0.001)

    beside = threading.Thread(target=count)
    beside.start()
    begun = time.monotonic()
    cr.robustness(cr.graphs.regular(100, 40, seed=1), limit_s=1.0, progress=False)
    spent = time.monotonic() - begun
    over.set()
    beside.join()
    assert counted[0] > 20 * spent
