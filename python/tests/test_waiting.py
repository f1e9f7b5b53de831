# SPDX-License-Identifier: BSD-3-Clause
"""What happens while a registration runs: progress, signals, threads, warnings."""
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
import warnings

import numpy as np
import pytest

import pcl_kss_icp
from conftest import Pair
from pcl_kss_icp import _core

# takes many seconds
LONG = {"even_rotations": 100000, "search_points": 128, "threads": 1, "device": "host",
        "mode": "overlap"}


def test_progress_is_told_stage_by_stage_on_this_thread(pair):
    told = []
    result = pcl_kss_icp.register(
        pair.source, pair.target,
        progress=lambda *said: told.append((*said, threading.get_ident())))
    assert {thread for _, _, thread in told} == {threading.get_ident()}
    stages = list(dict.fromkeys(stage for stage, _, _ in told))
    assert stages == list(result.seconds)
    for stage in stages:
        shares = [share for name, share, _ in told if name == stage]
        assert shares[0] == 0.0 and shares[-1] == 1.0 and shares == sorted(shares)


def test_what_progress_raises_ends_the_work(pair):
    class Mine(Exception):
        pass

    def progress(stage, share):
        if stage == "search":
            raise Mine(stage)

    kept = pcl_kss_icp.Registration(**LONG)
    start = time.monotonic()
    with pytest.raises(Mine, match="search"):
        kept.align(pair.source, pair.target, progress=progress)
    assert time.monotonic() - start < 5
    # and the next one is not affected
    quick = pcl_kss_icp.Registration()
    with pytest.raises(Mine):
        quick.align(pair.source, pair.target, progress=progress)
    assert quick.align(pair.source, pair.target)
    with pytest.raises(TypeError, match="progress is to be called"):
        quick.align(pair.source, pair.target, progress="bar")


def test_cancel_from_another_thread(pair):
    kept = pcl_kss_icp.Registration(**LONG)
    threading.Timer(0.3, kept.cancel).start()
    start = time.monotonic()
    result = kept.align(pair.source, pair.target)
    assert time.monotonic() - start < 1.5
    assert not result and result.cause == "stopped" and "cancelled" in result.reason


def test_cancel_while_clouds_are_converted(pair):
    class Cancelling:
        def __init__(self, registration):
            self.registration = registration

        def __array__(self, *_, **__):
            self.registration.cancel()
            return pair.source

    kept = pcl_kss_icp.Registration(**LONG)
    start = time.monotonic()
    result = kept.align(Cancelling(kept), pair.target)
    assert time.monotonic() - start < 1.5
    assert result.cause == "stopped" and "cancelled" in result.reason
    # the next one is not affected
    quick = pcl_kss_icp.Registration()
    with pytest.raises(ValueError, match="target: N x 3"):
        quick.align(Cancelling(quick), np.zeros(3))
    quick.cancel()
    assert quick.align(pair.source, pair.target)


def test_other_threads_run_meanwhile(pair):
    counted = 0
    ended = threading.Event()

    def count():
        nonlocal counted
        while not ended.is_set():
            counted += 1
            time.sleep(1e-3)

    counter = threading.Thread(target=count)
    counter.start()
    pcl_kss_icp.register(pair.source, pair.target, time_limit=1, **LONG)
    ended.set()
    counter.join()
    assert counted > 100


def test_two_registrations_at_once(pair):
    other = Pair(number=3000, scale=0.7)
    expected = [pcl_kss_icp.register(p.source, p.target).transformation for p in (pair, other)]
    found = {}

    def work(key, clouds):
        found[key] = [pcl_kss_icp.register(clouds.source, clouds.target).transformation
                      for _ in range(3)]

    threads = [threading.Thread(target=work, args=each) for each in enumerate((pair, other))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for key, truth in enumerate(expected):
        assert all(np.array_equal(pose, truth) for pose in found[key])


def test_one_registration_is_for_one_thread_at_a_time(pair):
    kept = pcl_kss_icp.Registration()

    def again(stage, share):
        kept.align(pair.source, pair.target)

    with pytest.raises(RuntimeError, match="This Registration is at work"):
        kept.align(pair.source, pair.target, progress=again)


INTERRUPTED = textwrap.dedent("""
    import signal, sys, time
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a job may ignore it
    sys.path.insert(0, {tests!r})
    import pcl_kss_icp
    from conftest import Pair
    from test_waiting import LONG
    pair = Pair()
    kept = pcl_kss_icp.Registration(**{{**LONG, "device": {device!r}}})
    print("ready", flush=True)
    try:
        kept.align(pair.source, pair.target)
    except KeyboardInterrupt:
        print(time.time(), flush=True)
        again = pcl_kss_icp.register(pair.source, pair.target)
        print("again" if again else again.reason)
""")


def seconds_to_interrupt(code, after):
    """From Ctrl-C to KeyboardInterrupt; None: it came before align() had begun."""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        time.sleep(after)
        sent = time.time()
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=30)
    if after == 0.0 and "KeyboardInterrupt" in errors:
        return None
    assert errors == ""
    raised, again = output.split()
    assert again == "again"
    return float(raised) - sent


@pytest.mark.parametrize("device", ["host", "auto"])
@pytest.mark.parametrize("after", [0.0, 0.02, 1.0])
def test_ctrl_c(device, after):
    code = INTERRUPTED.format(tests=os.path.dirname(__file__), device=device)
    # two tenths of a second, and as much for a machine that is busy, which it may be for
    # longer, but not three times on end
    for _ in range(3):
        seconds = seconds_to_interrupt(code, after)
        if seconds is None or seconds < 0.4:
            return
    pytest.fail(f"ended {seconds} s after Ctrl-C")


def test_handlers_of_the_program_run_meanwhile(pair):
    seen = []
    before = signal.signal(signal.SIGUSR1, lambda *_: seen.append(time.monotonic()))
    try:
        threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGUSR1)).start()
        pcl_kss_icp.register(pair.source, pair.target, time_limit=1.0, **LONG)
        ended = time.monotonic()
    finally:
        signal.signal(signal.SIGUSR1, before)
    assert len(seen) == 1 and ended - seen[0] > 0.4


def test_what_ends_with_an_exception_has_warned(pair, monkeypatch):
    told = ["it goes on the host"]
    monkeypatch.setattr(_core, "take_warnings", lambda: [told.pop()] if told else [])

    def progress(stage, share):
        raise KeyError(stage)

    with pytest.warns(RuntimeWarning, match="on the host"), pytest.raises(KeyError):
        pcl_kss_icp.register(pair.source, pair.target, progress=progress)
    assert told == []


WARNED = textwrap.dedent("""
    import sys, warnings
    sys.path.insert(0, {tests!r})
    import pcl_kss_icp
    from conftest import Pair
    pair = Pair(number=1000)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = pcl_kss_icp.register(pair.source, pair.target)
    [warning] = caught
    print(result.device, warning.category.__name__, warning.filename, warning.message)
""")


def test_without_opencl_it_warns_and_goes_on(tmp_path):
    run = subprocess.run(
        [sys.executable, "-c", WARNED.format(tests=os.path.dirname(__file__))],
        env={**os.environ, "OCL_ICD_VENDORS": str(tmp_path)}, check=True, text=True,
        capture_output=True)
    assert run.stderr == ""
    assert run.stdout.startswith("host RuntimeWarning <string> ")
    assert "host" in run.stdout.split("<string>")[1]


def test_nothing_is_warned_of_where_there_is_a_device(pair):
    if not pcl_kss_icp.device_names():
        pytest.skip("no OpenCL device")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert pcl_kss_icp.register(pair.source, pair.target)
