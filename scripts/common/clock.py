"""Processor time."""

import time


def time_task(task, *arguments, **options):
    """Return what a task returns, and the processor time [s] it took."""
    began = time.process_time()
    result = task(*arguments, **options)
    return result, time.process_time() - began
