"""Processes on this machine that share designs; one that dies loses no more than its chunk."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import queue
import signal
import threading
from collections import deque
from collections.abc import Generator, Iterator, Sequence
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess

from thesis_pin.errors import BadInput
from thesis_pin.numeric.workers import ctrl_c_later
from thesis_pin.sweep.designs.making import Designs
from thesis_pin.sweep.running.work import BLAS, Done, Task, work
from thesis_pin.sweep.study import Study, lost

_PATIENCE = 5.0
"""Seconds that a process has to end by itself."""


class _Worker:
    """A process of our own and the pipe to it.

    It reads the pipe all the time, so that it ends at once when this process does, however.
    """

    def __init__(self, study: Study, designs: Designs) -> None:
        context = multiprocessing.get_context("spawn")  # a fork would copy locks that threads hold
        self.pipe, theirs = context.Pipe()
        self.process: BaseProcess = context.Process(
            target=_serve, args=(theirs, study, designs), daemon=True
        )
        with _settings(), ctrl_c_later():
            self.process.start()
        theirs.close()
        self.task = Task(-1, (), ())

    def give(self, task: Task) -> None:
        """Send a task; a process that is dead by now is heard of when it should answer."""
        self.task = task
        with contextlib.suppress(OSError):
            self.pipe.send(task)

    def take(self) -> Done | Exception | None:
        """What came of its task; None if it died of it."""
        try:
            found: Done | Exception = self.pipe.recv()
        except (EOFError, OSError):
            return None
        return found

    def end(self) -> int:
        """End it; its exit code, below zero for a signal."""
        self.pipe.close()
        self.process.join(_PATIENCE)
        if self.process.is_alive():
            self.process.kill()
            self.process.join()
        return self.process.exitcode or 0


def shared(
    study: Study, designs: Designs, tasks: Sequence[Task], jobs: int
) -> Generator[tuple[Task, Done]]:
    """Tasks with what came of them, in the order in which they are done.

    A task whose process dies is tried again, each of its designs alone; one that a process dies
    of again is a row that says so. A script has to call this below
    ``if __name__ == "__main__"``, since the processes are new ones.

    Args:
        study: What is asked.
        designs: What varies.
        tasks: Which designs.
        jobs: Number of processes.

    Raises:
        BadInput: Processes can't be begun.
    """
    left = deque(tasks)
    tried: set[tuple[int, ...]] = set()
    bare = Designs(designs.parameters, ())
    workers: list[_Worker] = []
    try:
        for _ in range(min(jobs, len(left))):
            workers.append(_Worker(study, bare))
            workers[-1].give(left.popleft())
        while workers:
            for pipe in wait([worker.pipe for worker in workers]):
                worker = next(one for one in workers if one.pipe is pipe)
                task, answer = worker.task, worker.take()
                if isinstance(answer, Exception):
                    raise answer
                if answer is None:
                    workers.remove(worker)
                    yield from _again(study, task, worker.end(), tried, left)
                    if not left:
                        continue
                    worker = _Worker(study, bare)
                    workers.append(worker)
                else:
                    yield task, answer
                if left:
                    worker.give(left.popleft())
                else:
                    workers.remove(worker)
                    worker.end()
    finally:
        for worker in workers:
            worker.process.kill()  # whatever it is at
            worker.end()


def _again(
    study: Study, task: Task, code: int, tried: set[tuple[int, ...]], left: deque[Task]
) -> Iterator[tuple[Task, Done]]:
    """Try a task again, each design alone, or give the row of one that was.

    Raises:
        BadInput: The process ended by itself, which it never does where a script is right.
    """
    if code >= 0:
        raise BadInput(
            f"a process of the sweep ended with code {code}",
            where="jobs",
            remedy='In a script, call it below if __name__ == "__main__"',
        )
    if task.designs in tried:
        row = lost(study, task.designs[0], task.values[0], f"its process {_ended(code)}, twice")
        yield task, Done((row,), 0.0, {})
        return
    for one in task.alone():
        tried.add(one.designs)
        left.append(one)


def _ended(code: int) -> str:
    """How a signal ended a process, in words."""
    try:
        name = signal.Signals(-code).name
    except ValueError:
        return f"was ended by signal {-code}"
    more = ", as systems do that run out of memory" if name == "SIGKILL" else ""
    return f"was ended by {name}{more}"


@contextlib.contextmanager
def _settings() -> Iterator[None]:
    """One BLAS thread for processes that are begun meanwhile."""
    before = {name: os.environ.get(name) for name in BLAS}
    os.environ.update(dict.fromkeys(BLAS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


def _serve(pipe: Connection, study: Study, designs: Designs) -> None:
    """What a process does until the pipe is closed."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    tasks: queue.SimpleQueue[Task] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(pipe, tasks), daemon=True).start()
    while True:
        task = tasks.get()
        try:
            answer: Done | Exception = work(study, designs, task)
        except Exception as error:
            answer = BadInput(f"{type(error).__name__}: {error}", where="a process of the sweep")
        with contextlib.suppress(OSError):
            pipe.send(answer)


def _listen(pipe: Connection, tasks: queue.SimpleQueue[Task]) -> None:
    """Pass tasks on; end this process when nobody is left who could send any."""
    with contextlib.suppress(EOFError, OSError):
        while True:
            tasks.put(pipe.recv())
    os._exit(0)
