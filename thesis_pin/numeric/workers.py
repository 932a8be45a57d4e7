"""What long work has in common: progress that may be watched."""


def silent(done: int, total: int) -> None:
    """Progress that nobody watches."""
