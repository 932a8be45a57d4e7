"""A Dask cluster that shares designs: the same rows, from as many machines as it has."""

from __future__ import annotations

import contextlib
import os
import threading
from collections.abc import Generator, Iterator, Sequence
from typing import TYPE_CHECKING

from thesis_pin.errors import BadInput
from thesis_pin.sweep.designs.making import Designs
from thesis_pin.sweep.running.work import BLAS, Done, Task, work
from thesis_pin.sweep.study import Study, lost

if TYPE_CHECKING:
    from distributed import Client, Future

PATIENCE = 30.0
"""Seconds in which a scheduler has to answer and have a worker."""

_ONE_AT_A_TIME = threading.Lock()  # warnings are caught for the whole process


def on_cluster(
    study: Study, designs: Designs, tasks: Sequence[Task], address: str
) -> Generator[tuple[Task, Done]]:
    """Tasks with what came of them, in the order in which they are done.

    Dask itself gives the tasks of a worker that died to others. Of a task that is blamed for the
    death of several, each design is tried alone at the end; one that workers die of even so is a
    row that says so.

    Args:
        study: What is asked.
        designs: What varies.
        tasks: Which designs.
        address: Of the scheduler, as ``tcp://127.0.0.1:8786``.

    Raises:
        BadInput: Dask isn't installed, nobody answers there, or the scheduler has gone.
    """
    try:
        import distributed
        from distributed import as_completed
        from distributed.scheduler import KilledWorker
    except ImportError:
        raise BadInput(
            "a Dask cluster needs Dask",
            where="scheduler",
            remedy='pip install "thesis-pin[distributed]", here and where its workers run',
        ) from None
    bare = Designs(designs.parameters, ())
    with _client(address) as client:
        # A task rather than scattered data, which die with the workers that hold them.
        what = client.submit(_given, study, bare, pure=False)

        def ask(task: Task) -> Future[Done]:
            return client.submit(_worked, what, task, pure=False)

        asked = {ask(task): task for task in tasks}
        blamed: list[Task] = []
        waiting = as_completed(list(asked), loop=client.loop)
        try:
            for future in waiting:
                task = asked.pop(future)
                if future.status == "finished":
                    yield task, future.result()
                elif future.status in ("lost", "pending"):  # its worker died with the answer
                    asked[future] = task
                    waiting.add(future)
                else:
                    _killed(address, future)
                    blamed += task.alone()
            for task in blamed:  # one by one, since Dask blames all that waited for that worker
                future = ask(task)
                asked[future] = task
                try:
                    yield task, future.result()
                except KilledWorker as error:
                    reason = f"{error.allowed_failures + 1} workers died of it, one after the other"
                    row = lost(study, task.designs[0], task.values[0], reason)
                    yield task, Done((row,), 0.0, {})
                del asked[future]
        except (OSError, distributed.client.FutureCancelledError) as error:
            raise _gone(address, error) from None
        finally:
            with contextlib.suppress(Exception):  # a scheduler that has gone has nothing to cancel
                client.cancel(list(asked))


def _killed(address: str, future: Future[Done]) -> None:
    """Refuse a task that failed by anything but its workers' deaths.

    Raises:
        BadInput: It did.
    """
    from distributed.scheduler import KilledWorker

    error = future.exception() if future.status == "error" else None
    if not isinstance(error, KilledWorker):
        raise _gone(address, error)


def _given(study: Study, designs: Designs) -> tuple[Study, Designs]:
    return study, designs


def _worked(what: tuple[Study, Designs], task: Task) -> Done:
    """A task on a worker: the only one in its process, with one BLAS thread."""
    from threadpoolctl import threadpool_limits

    with _ONE_AT_A_TIME:
        os.environ.update(dict.fromkeys(BLAS, "1"))  # of libraries that aren't loaded yet
        with threadpool_limits(1):
            return work(*what, task)


@contextlib.contextmanager
def _client(address: str) -> Iterator[Client]:
    """A connection to a scheduler that has at least one worker.

    Raises:
        BadInput: Nobody answers, or no worker is there.
    """
    from distributed import Client

    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TypeError, ImportError) as error:
        raise BadInput(
            f"no Dask scheduler answers at {address!r}: {str(error).splitlines()[0]}",
            where="scheduler",
            allowed="an address as tcp://127.0.0.1:8786",
            remedy="Start one: dask scheduler",
        ) from None
    try:
        try:
            client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError:
            raise BadInput(
                f"the scheduler at {address} has no workers",
                where="scheduler",
                remedy=f"Start some: dask worker {address} --nthreads 1 --nworkers 4",
            ) from None
        yield client
    finally:
        with contextlib.suppress(Exception):
            client.close(timeout=PATIENCE)


def _gone(address: str, error: BaseException | None) -> BadInput:
    why = f": {type(error).__name__}: {error}" if error is not None else ""
    return BadInput(
        f"the Dask cluster at {address} gave no answer{why}",
        where="scheduler",
        remedy="What is done is kept with --out; --resume goes on",
    )
