"""What takes long, worked out once for all processes that share a run of the tests."""

import fcntl
import pickle


def once(request, factory, make):
    """What ``make()`` gives, made by whichever process asks first; the others read it."""
    folder = factory.getbasetemp()
    if hasattr(request.config, "workerinput"):
        folder = folder.parent  # all workers' own
    file = folder / f"{make.__module__}.{make.__qualname__}.pickle"
    with open(file.with_suffix(".lock"), "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not file.exists():
            made = make()
            file.write_bytes(pickle.dumps(made))
            return made
    return pickle.loads(file.read_bytes())
