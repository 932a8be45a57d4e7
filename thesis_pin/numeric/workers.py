"""What long work has in common: progress that may be watched, processes that share it."""

from __future__ import annotations

import contextlib
import os
import signal
import threading
from collections.abc import Callable, Generator, Sequence
from typing import TYPE_CHECKING, TypeVar

from thesis_pin.errors import BadInput

if TYPE_CHECKING:  # progress alone needs no processes: a tenth of Pinocchio's import
    from multiprocessing.connection import Connection

Task = TypeVar("Task")
Result = TypeVar("Result")


def silent(done: int, total: int) -> None:
    """Progress that nobody watches."""


def shared(
    work: Callable[[Task], Result],
    tasks: Sequence[Task],
    jobs: int,
    begin: Callable[[], object],
) -> Generator[Result]:
    """Results of tasks that several processes share, in the order in which they are done.

    The processes are new ones, so a script has to call this below
    ``if __name__ == "__main__"``. They end with the last task, and at once where the caller
    stops, is interrupted or dies.

    Args:
        work: Does a task. It, ``begin``, tasks and results are sent by :mod:`pickle`.
        tasks: What is to be done, what takes long first.
        jobs: Number of processes.
        begin: Called in each process before its first task.

    Yields:
        What ``work`` returns; what it raises is raised here.

    Raises:
        BadInput: A process was killed, as systems do that run out of memory.
    """
    import multiprocessing
    from concurrent.futures import ProcessPoolExecutor, as_completed
    from concurrent.futures.process import BrokenProcessPool

    context = multiprocessing.get_context("spawn")  # a fork would copy locks that threads hold
    ear, mouth = context.Pipe(duplex=False)
    with (
        ear,
        mouth,
        ProcessPoolExecutor(jobs, context, initializer=_begin, initargs=(ear, begin)) as pool,
    ):
        try:
            with ctrl_c_later():
                asked = [pool.submit(work, task) for task in tasks]
            for done in as_completed(asked):
                yield done.result()
        except BrokenProcessPool as error:
            raise BadInput(
                "a process that shared the work was killed",
                where="jobs",
                remedy="Use fewer: each needs memory of its own",
            ) from error
        except BaseException:
            mouth.close()  # ends them whatever they are at
            pool.shutdown(wait=False, cancel_futures=True)
            raise


@contextlib.contextmanager
def ctrl_c_later() -> Generator[None]:
    """Keep Ctrl-C back; processes that are begun meanwhile never get it.

    They inherit that the signal is blocked. Blocking it doesn't keep it from the caller: another
    thread of this process may take it, a library's say, and Python then interrupts this one.
    """
    kept: list[int] = []
    handler = signal.getsignal(signal.SIGINT)
    ours = handler is not None and threading.current_thread() is threading.main_thread()
    if ours:
        signal.signal(signal.SIGINT, lambda number, _: kept.append(number))
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        if ours:
            signal.signal(signal.SIGINT, handler)
        if kept:
            signal.raise_signal(signal.SIGINT)


def _begin(ear: Connection, begin: Callable[[], object]) -> None:
    threading.Thread(target=_end_with, args=(ear,), daemon=True).start()
    begin()


def _end_with(ear: Connection) -> None:
    """End this process when nobody is left who could speak to it."""
    with contextlib.suppress(EOFError, OSError):
        ear.recv()
    os._exit(1)
